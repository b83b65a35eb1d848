/** What may not be exceeded on any training road. */

import { ActionIcon, TextInput } from "@mantine/core";
import { IconX } from "../icons";
import { fullName, type Figure } from "../batch/figures";
import type { DraftErrors } from "../submission/problems";
import { prettyUnit } from "../units/format";
import { limitOf, MOST_LIMITS, type LimitDraft } from "./draft";
import { FigureSelect } from "./FigureSelect";
import classes from "./tuner.module.css";
import { Fault } from "../ui/Fault";
import ui from "../ui/ui.module.css";

interface Props {
  readonly limits: readonly LimitDraft[];
  readonly figures: readonly Figure[];
  readonly errors: DraftErrors;
  readonly onChange: (limits: readonly LimitDraft[]) => void;
}

export function LimitRows({ limits, figures, errors, onChange }: Props) {
  return (
    <div className={classes.rows}>
      {limits.map(({ figure: name, atMost }, index) => {
        const figure = figures.find(({ key }) => key === name);
        const title = figure ? fullName(figure) : name;
        const unit = prettyUnit(figure?.unit ?? "1");
        const error = errors[`limits.${index}`];
        return (
          <div key={name} className={classes.row} role="group" aria-label={`Limit: ${title}`} data-error={error !== undefined || undefined}>
            <div className={classes.rowHead}>
              <span className={classes.rowTitle}>{title}</span>
              <span className={ui.dim}>at most</span>
              <TextInput
                size="xs"
                className={classes.short ?? ""}
                aria-label={`${title}, at most`}
                inputMode="decimal"
                value={atMost}
                error={error !== undefined}
                {...(unit === "" ? {} : { rightSection: <span className={ui.dim}>{unit}</span>, rightSectionWidth: 44 })}
                rightSectionPointerEvents="none"
                onChange={(event) => {
                  const typed = event.currentTarget.value;
                  onChange(limits.map((each) => (each.figure === name ? { ...each, atMost: typed } : each)));
                }}
              />
              <ActionIcon className={classes.remove ?? ""} size={24} variant="subtle" color="gray" aria-label={`Remove the limit of ${title}`} onClick={() => onChange(limits.filter((each) => each.figure !== name))}>
                <IconX size={15} />
              </ActionIcon>
            </div>
            {error !== undefined && (
              <Fault>{error}</Fault>
            )}
          </div>
        );
      })}
      {limits.length < MOST_LIMITS && (
        <FigureSelect
          label="Add a limit"
          figures={figures.filter(({ key }) => !limits.some(({ figure }) => figure === key))}
          error={errors.limits}
          onPick={(key) => onChange([...limits, limitOf(key)])}
        />
      )}
    </div>
  );
}
