/** Data, pictures and commands of what is shown. */

import { Button, Menu, Modal, Text, Textarea, Group, SegmentedControl, Select } from "@mantine/core";
import { Icon, type IconName } from "../../ui/icons";
import { useMutation, useQueryClient } from "@tanstack/react-query";
import { useState } from "react";
import { address, askFile } from "../../api/http";
import { explain } from "../../api/problem";
import { useCompared } from "../compare/useCompared";
import { useAction, useActionButton, type ActionId } from "../../lab/actions";
import { whyNotCompared } from "../../lab/compare";
import { useLabContext, useLab, useView } from "../../lab/context";
import { useLabStrategies } from "../../lab/recordings";
import { useFigures, useForm } from "../../server/useCatalogues";
import { roadsOf } from "../../lab/result";
import { axisKey, baselineOf, makeResultView } from "../../lab/resultView";
import { asCommand, asCurl, asPython, type CopyRequest } from "./copyAs";
import { settledCurves, ownLaws, type Curves } from "../../plots/curves";
import { useCopied } from "../../ui/useCopied";
import { download } from "../../lib/download";
import { type FmuRequest, type Scenario, type Strategy, type FigureTemplates } from "../../api/types";
import { labelled } from "../../ui/Entry";
import { Fault } from "../../ui/Messages";
import { FileFault, SaveMenu, useController, saveAs } from "./FileMenu";
import { buildFigure, axisUnit, overRoads } from "../../plots/figure";
import { ON_PAPER } from "../../plots/palettes";
import { onPaper } from "../../plots/paperFigure";
import { asText, loadPlotly, withPlainNames, type PlotFigure } from "../../plots/plotly";

const FORMATS = [
  { format: "csv", label: "CSV" },
  { format: "json", label: "JSON" },
] as const;

export function ExportMenu() {
  const isShown = useLab(({ shown }) => shown !== null);
  const runId = useLab(({ shown }) => shown?.runId ?? null);
  const hasHistories = useLab(({ shown }) => shown?.missing === null);
  const computed = useLab(({ shown }) => Object.keys(shown?.summaries ?? {}).join());
  const selected = useLab((state) => state.strategies);
  const view = useView();
  const compared = useCompared();
  const { lab } = useLabContext();
  const [figures, strategies, form] = [useFigures(), useLabStrategies(), useForm()];
  const [refused, setRefused] = useState<string | null>(null);
  const [fmu, setFmu] = useState(false);
  const { copied, copy } = useCopied(setRefused);
  const controller = useController();

  const queries = useQueryClient();
  const picture = useMutation({
    mutationFn: async (format: "png" | "svg") => {
      await queries.refetchQueries({ type: "active", predicate: ({ state }) => state.status === "error" });
      const curves = await settledCurves();
      download(await plotsImage(figures, curves, format), `ridelab-${curves.runId ?? "live"}.${format}`);
    },
  });
  const saveReport = () => {
    const { shown } = lab.get();
    if (!shown || runId === null) return;
    const { baseline, reference } = makeResultView(shown, strategies, selected, view, compared);
    const run = reference && whyNotCompared(shown, reference.shown) === null ? reference.shown.runId : null;
    const requirements = view.requirements.length > 0 ? JSON.stringify(view.requirements) : null;
    const refersTo = { baseline: run === null ? baseline : null, against: run, requirements };
    download(
      address("/runs/{id}/report.html", { path: { id: runId }, query: { x: axisKey(view.axis), ...refersTo } }),
      `ridelab-${runId}.html`,
    );
  };
  const scenario = () => lab.get().history?.present ?? lab.get().shown?.scenario ?? {};
  const copyAs = (write: (request: CopyRequest) => string) => {
    const { shown } = lab.get();
    copy(
      write({
        origin: window.location.origin,
        form,
        scenario: scenario(),
        strategies: selected,
        roads: shown ? roadsOf(shown) : 1,
        baseline: shown && baselineOf(shown, view.baseline),
        requirements: view.requirements,
      }),
    );
  };

  useAction("report", runId === null ? null : saveReport);
  useAction("png", hasHistories ? () => picture.mutate("png") : null);
  useAction("svg", hasHistories ? () => picture.mutate("svg") : null);
  useAction("controller", () => controller.save(scenario()));
  useAction("fmu", () => setFmu(true));
  useAction("python", () => copyAs(asPython));
  useAction("command", () => copyAs(asCommand));
  useAction("curl", () => copyAs(asCurl));

  return (
    <>
      <SaveMenu disabled={!isShown} loading={controller.saving || picture.isPending} {...{ copied }}>
        <Menu.Label>Time histories, full resolution</Menu.Label>
        {strategies
          .filter(({ id }) => computed.split(",").includes(id) && selected.includes(id))
          .map(({ id, label }) => (
            <Group key={id} gap={0} wrap="nowrap">
              <Text flex={1} pl="0.75rem" truncate>
                {label}
              </Text>
              {FORMATS.map(({ format, label: name }) => (
                <Menu.Item
                  key={format}
                  w="auto"
                  px="0.6rem"
                  fw={600}
                  aria-label={`${label} as ${name}`}
                  disabled={runId === null || !hasHistories}
                  onClick={() =>
                    download(
                      address("/runs/{id}/series", { path: { id: runId ?? "" }, query: { strategy: id, format } }),
                      `ridelab-${runId ?? ""}-${id}.${format}`,
                    )
                  }
                >
                  {name}
                </Menu.Item>
              ))}
            </Group>
          ))}
        <Menu.Label>Everything in one file</Menu.Label>
        <ActionItem id="report" icon="FileText" />
        <Menu.Label>Plots as shown</Menu.Label>
        <ActionItem id="png" icon="Photo" />
        <ActionItem id="svg" icon="Photo" />
        <Menu.Label>As a program</Menu.Label>
        <ActionItem id="controller" icon="Cpu" />
        <ActionItem id="fmu" icon="PlugConnected" />
        <Menu.Label>This run again, elsewhere</Menu.Label>
        <ActionItem id="python" icon="BrandPython" />
        <ActionItem id="command" icon="Terminal2" />
        <ActionItem id="curl" icon="WorldUpload" />
      </SaveMenu>
      {fmu && <FmuDialog {...{ strategies, scenario }} first={selected[0]} onClose={() => setFmu(false)} />}
      {controller.fault}
      <FileFault title="The plots could not be saved" error={picture.error} reset={picture.reset} />
      <Modal
        opened={refused !== null}
        onClose={() => setRefused(null)}
        title="Select the address and copy it"
        size="lg"
      >
        <Textarea
          readOnly
          autosize
          maxRows={14}
          data-autofocus
          aria-label="Text to copy"
          size="xs"
          styles={{ input: { fontFamily: "var(--mantine-font-family-monospace)" } }}
          value={refused ?? ""}
          onFocus={(event) => event.currentTarget.select()}
        />
      </Modal>
    </>
  );
}

function ActionItem({ id, icon }: { readonly id: ActionId; readonly icon: IconName }) {
  const { label, ...item } = useActionButton(id);
  return (
    <Menu.Item leftSection={<Icon name={icon} size={16} />} {...item}>
      {label}
    </Menu.Item>
  );
}

const VEHICLE = "vehicle" as const;
const VERSIONS = ["2.0", "3.0"] as const;

interface Props {
  readonly strategies: readonly Strategy[];
  /** The strategy that is asked about first. */
  readonly first: string | undefined;
  readonly scenario: () => Scenario;
  readonly onClose: () => void;
}

/** A controller or the vehicle as an FMU, which Simulink, CarMaker and Modelica tools import. */
function FmuDialog({ strategies, first, scenario, onClose }: Props) {
  const [what, setWhat] = useState<string>(first ?? VEHICLE);
  const [version, setVersion] = useState<NonNullable<FmuRequest["version"]>>("2.0");
  const file = useMutation({
    mutationFn: () => {
      const of = what === VEHICLE ? { of: VEHICLE } : { strategy: what };
      return askFile("post", "/fmus", { body: { scenario: scenario(), version, ...of } }, (response) =>
        response.blob(),
      );
    },
    onSuccess: (fmu) => saveAs(fmu, `ridelab-${what}.fmu`),
  });
  const change = (to: () => void) => {
    file.reset();
    to();
  };
  return (
    <Modal opened onClose={onClose} title="Export an FMU">
      <Text c="dimmed" size="sm">
        For co-simulation in Simulink, CarMaker, Modelica tools and Python, with the C sources and programs for Linux,
        Windows and macOS as far as the service has them.
      </Text>
      <Group gap="xs" align="flex-end" my="sm">
        <Select
          label="What"
          w={260}
          allowDeselect={false}
          data={[
            { group: "Controller of", items: labelled(strategies) },
            { group: "Or", items: [{ value: VEHICLE, label: "The vehicle" }] },
          ]}
          value={what}
          onChange={(value) => value !== null && change(() => setWhat(value))}
        />
        <SegmentedControl
          aria-label="Version of FMI"
          data={VERSIONS.map((value) => ({ value, label: `FMI ${value}` }))}
          value={version}
          onChange={(value) => change(() => setVersion(value === "3.0" ? "3.0" : "2.0"))}
        />
      </Group>
      {file.error && <Fault>{explain(file.error)}</Fault>}
      <Group justify="flex-end" gap="xs" mt="sm">
        <Button size="sm" onClick={onClose}>
          Close
        </Button>
        <Button size="sm" variant="filled" loading={file.isPending} onClick={() => file.mutate()}>
          Export
        </Button>
      </Group>
    </Modal>
  );
}

/** All shown plots as one picture. */
const WIDTH = 1200;
const PANEL_HEIGHT = 190;
/** Room for the line at the foot that says where the picture comes from. */
const FOOT = 34;
const LINE = 15;
const GAP = 0.28; // of a panel, for its title

/** One figure with a row for each panel over one x axis. */
function stackFigures(figures: FigureTemplates, curves: Curves): PlotFigure & { readonly height: number } {
  const templates = Object.values(figures);
  const { axis, minus, roads, runId, coreVersion } = curves;
  const row = 1 / templates.length;
  const built = templates.map((template) =>
    buildFigure({
      template,
      ...curves,
      isolated: null,
      strategies: onPaper(template, curves.strategies),
      palette: ON_PAPER,
    }),
  );
  const name = (letter: "x" | "y", index: number) => (index === 0 ? letter : `${letter}${index + 1}`);
  const axes: Record<string, unknown> = {};
  built.forEach(({ layout }, index) => {
    const top = 1 - index * row;
    const suffix = index === 0 ? "" : String(index + 1);
    axes[`xaxis${suffix}`] = { ...layout.xaxis, anchor: name("y", index) };
    axes[`yaxis${suffix}`] = {
      ...layout.yaxis,
      anchor: name("x", index),
      domain: [top - row * (1 - GAP), top - row * 0.12],
    };
  });
  const data = built.flatMap((figure, index) =>
    withPlainNames(figure.data).map((trace) => ({
      ...trace,
      xaxis: name("x", index),
      yaxis: name("y", index),
      showlegend: index === 0 && trace.showlegend !== false,
    })),
  );
  const shapes = built.flatMap(({ layout }, index) =>
    layout.shapes.map((shape) => ({
      ...shape,
      xref: shape.xref === "paper" ? `${name("x", index)} domain` : name("x", index),
      yref: shape.yref === "paper" ? `${name("y", index)} domain` : name("y", index),
    })),
  );
  const annotations: Readonly<Record<string, unknown>>[] = templates.map(({ layout: { meta } }, index) => ({
    text: `<b>${meta.title}</b> [${meta.unit}]${minus === undefined ? "" : `, less ${asText(minus)}`}`,
    xref: "paper",
    yref: "paper",
    x: 0,
    y: 1 - index * row - row * 0.1,
    xanchor: "left",
    yanchor: "bottom",
    showarrow: false,
    font: { size: 13, color: ON_PAPER.text },
  }));
  const source = `Ridelab core ${coreVersion}${runId === null ? ", a live preview" : `, run ${runId}`}`;
  const laws = ownLaws(curves).map(asText);
  const foot = FOOT + LINE * laws.length;
  annotations.push({
    text: [source, ...laws].join("<br>"),
    align: "left",
    xref: "paper",
    yref: "paper",
    x: 0,
    y: 0,
    xanchor: "left",
    yanchor: "top",
    yshift: -30,
    showarrow: false,
    font: { size: 11, color: ON_PAPER.text },
  });
  return {
    data,
    height: PANEL_HEIGHT * templates.length + foot,
    layout: {
      ...axes,
      shapes,
      annotations,
      title: {
        text: `Ridelab: time histories over ${axis} [${axisUnit(axis)}]${roads === undefined ? "" : `. ${overRoads(roads, minus !== undefined)}`}`,
        font: { size: 15 },
        x: 0.03,
      },
      font: { family: "Arial, sans-serif", color: ON_PAPER.text },
      paper_bgcolor: "#ffffff",
      plot_bgcolor: "#ffffff",
      margin: { l: 60, r: 20, t: 70, b: 30 + foot },
      showlegend: true,
      legend: { traceorder: "normal", orientation: "h", y: 1, yanchor: "bottom", x: 1, xanchor: "right" },
    },
  };
}

async function plotsImage(figures: FigureTemplates, curves: Curves, format: "png" | "svg"): Promise<string> {
  const { height, ...figure } = stackFigures(figures, curves);
  const plotly = await loadPlotly();
  return plotly.toImage(figure, { format, width: WIDTH, height, scale: format === "png" ? 2 : 1 });
}
