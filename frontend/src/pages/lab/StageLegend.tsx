/** What the shading and the lines behind the curves mean. */

import { Box, Button, Group } from "@mantine/core";
import { useMediaQuery } from "@mantine/hooks";
import { useCatalogue, useFigures } from "../../server/useCatalogues";
import { layersOf } from "../../plots/curves";
import { stagedStrategy } from "../../plots/shapes";
import { useCurves } from "../../plots/useDetail";
import type { ResultView } from "../../lab/resultView";
import { LineKey, StrategyName } from "../../ui/StrategyKey";
import ui from "../../ui/ui.module.css";
import { holdIsolated, isolateWhilePointed, useIsolated } from "../../lab/cursor";

/** A swatch is small: the shading three times over, so that it can be told apart. */
const layered = (fill = "transparent") => Array<string>(3).fill(`linear-gradient(${fill}, ${fill})`).join(", ");

const BAND = {
  borderColor: "transparent",
  background: "linear-gradient(rgb(127 127 127 / 30%) 42%, rgb(127 127 127) 42% 58%, rgb(127 127 127 / 30%) 58%)",
};

export function StageLegend({ resultView }: { readonly resultView: ResultView }) {
  const catalogue = useCatalogue();
  const meta = Object.values(useFigures())[0]?.layout.meta;
  const stages = catalogue.stages.filter(({ key }) => key in (meta?.stage_fills ?? {}));
  const staged = resultView.strategies.find(({ id }) => id === stagedStrategy(resultView.summaries, resultView.ids));
  const airborne = resultView.ids.some((id) => Number(resultView.summaries[id]?.events.airborne_ms ?? 0) > 0);
  const hasBand = useCurves(resultView).roads !== undefined && !resultView.differences;
  const held = useIsolated();
  const isTouched = useMediaQuery("(hover: none)");
  const layers = resultView.differences ? [] : layersOf(resultView, resultView.shown.runId);
  const several = resultView.axis === "time" && resultView.ids.length > 1;
  return (
    <Group gap="0.2rem 1.1rem" m="0.1rem 0.2rem" fz="xs" c="dimmed">
      {resultView.ids.length > 1 &&
        resultView.strategies.map((strategy) => (
          <Button
            key={strategy.id}
            size="compact-xs"
            variant={held === strategy.id ? "default" : "subtle"}
            color="gray"
            fw={400}
            {...(held !== strategy.id && { c: "dimmed" })}
            aria-pressed={held === strategy.id}
            title={`Make ${strategy.label} stand out`}
            onClick={() => holdIsolated(strategy.id)}
            {...isolateWhilePointed(strategy.id)}
          >
            <StrategyName strategy={strategy} />
          </Button>
        ))}
      {stages.map(({ key, label, description }) => (
        <span key={key} title={description}>
          <span className={ui.area} style={{ background: layered(meta?.stage_fills[key]) }} /> {label}
        </span>
      ))}
      <span>
        <LineKey colour={meta?.neutral ?? "currentColor"} width={1.5} dash="4 2" /> limit, static load or target
      </span>
      {layers.map(({ name, line }, index) => (
        <span key={index} data-layer={name}>
          <LineKey {...line} /> {name}
        </span>
      ))}
      {hasBand && (
        <span>
          <span className={ui.area} style={BAND} /> range: minimum to maximum of {resultView.shown.over?.roads} roads
        </span>
      )}
      {(airborne || hasBand) && (
        <span>
          <span className={ui.area} style={{ background: "rgb(127 127 127 / 45%)" }} /> tyre off the road
          {hasBand && " on at least one road"}
        </span>
      )}
      {several && <span>Stages shaded for {staged?.label}; the marks on top: each strategy on the bump</span>}
      <Box component="span" ml="auto" data-unprinted>
        {isTouched ? "Slide along a plot to read it" : "Drag across a plot to zoom, double click for the whole run"}
      </Box>
    </Group>
  );
}
