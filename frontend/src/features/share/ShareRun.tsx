/** Shares what the dashboard shows. */

import { ask } from "../../api/http";
import { useCompared } from "../compare/useCompared";
import { useLabContext, useLab } from "../../lab/context";
import { cursor } from "../../lab/cursor";
import type { LabState } from "../../lab/labState";
import { useLabStrategies } from "../../lab/recordings";
import { makeResultView } from "../../lab/resultView";
import { viewToShare } from "../../lab/sharing";
import { ShareLink } from "./ShareLink";

const OPENS =
  "It opens this scenario with these results, strategies, comparison, zoom, cursor, instant and pins, for anyone who has the link. It is read-only.";

function obstacleOf({ failure, shown, stale, serverErrors }: LabState): string | null {
  if (failure?.kind === "unreachable") return "The server does not answer";
  if (failure?.kind === "notFound") return "There is no result here";
  if (failure || Object.keys(serverErrors.fields).length + serverErrors.general.length > 0)
    return "These values could not be run";
  if (shown?.source !== "exact" || stale) return "There is no result of these values yet";
  return null;
}

export function ShareRun() {
  const { lab, labAddress } = useLabContext();
  const obstacle = useLab(obstacleOf);
  const catalogue = useLabStrategies();
  const compared = useCompared();
  const make = () => {
    const { shown, strategies } = lab.get();
    if (!shown?.runId) return Promise.reject(new Error("there is no result"));
    const { view } = labAddress.get();
    const resultView = makeResultView(shown, catalogue, strategies, view, compared);
    return ask("post", "/links", {
      body: {
        run_id: shown.runId,
        view: viewToShare(resultView, cursor.get(resultView.axis), view.instant),
        requirements: view.requirements,
      },
    });
  };
  return <ShareLink make={make} obstacle={obstacle} opens={OPENS} />;
}
