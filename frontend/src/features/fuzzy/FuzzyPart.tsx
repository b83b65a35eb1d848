/** Opens the panel of the fuzzy speed controller; its code is fetched when somebody first asks. */

import { useDisclosure } from "@mantine/hooks";
import { lazy } from "react";
import { useAction } from "../../lab/actions";
import { useLabContext, useView } from "../../lab/context";
import type { ResultView } from "../../lab/resultView";
import { LazyPart } from "../../ui/LazyPart";

const FuzzyPanel = lazy(() => import("./FuzzyPanel").then((module) => ({ default: module.FuzzyPanel })));

export function FuzzyPart({ resultView }: { readonly resultView: ResultView }) {
  const { labAddress } = useLabContext();
  const { instant } = useView();
  const [opened, { open, close }] = useDisclosure(false);
  useAction("fuzzy", () => {
    labAddress.setView({ instant: null }); // it has the same place
    open();
  });
  if (!opened || instant !== null) return null;
  return (
    <LazyPart onClose={close}>
      <FuzzyPanel resultView={resultView} onClose={close} />
    </LazyPart>
  );
}
