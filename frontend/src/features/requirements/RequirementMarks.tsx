/** Whether a number keeps what is required of it: a word and a sign, colour only repeats them. */

import type { RequirementResult } from "../../api/types";
import { Icon } from "../../ui/icons";
import { limitText, RESULT_WORDS } from "./judged";
import { useCatalogues } from "../../server/useCatalogues";
import type { ReactNode } from "react";
import { Box } from "@mantine/core";
import ui from "../../ui/ui.module.css";

const SIGNS = { pass: "Check", fail: "X", uncertain: "AlertTriangle" } as const;

export function RequirementMarks({ results }: { readonly results: readonly RequirementResult[] }) {
  if (results.length === 0) return null;
  return results.map((result, index) => <RequirementMark key={index} result={result} />);
}

export function RequirementMark({ result }: { readonly result: RequirementResult }) {
  const figure = useCatalogues().figures.find(({ key }) => key === result.metric);
  const limit = limitText(result, figure, result.baseline);
  return (
    <ResultMark result={result.result} title={`Required: ${limit}`}>
      <span className="visually-hidden">, required {limit}</span>
    </ResultMark>
  );
}

interface MarkProps {
  readonly result: RequirementResult["result"];
  readonly title?: string;
  readonly children?: ReactNode;
}

export function ResultMark({ result, title, children }: MarkProps) {
  return (
    <Box component="span" className={ui.mark ?? ""} mr="0.35rem" fz="xs" data-result={result} title={title}>
      <Icon name={SIGNS[result]} size={12} stroke={2.4} /> {RESULT_WORDS[result]}
      {children}
    </Box>
  );
}
