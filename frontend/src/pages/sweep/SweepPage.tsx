/** A sweep: how far it is, its plot and its rows. */

import { useParams } from "@tanstack/react-router";
import { type Link, type Batch, type SharedView, type BatchRequirements as Answer } from "../../api/types";
import { BATCH, useJob } from "../../jobs/useJob";
import { Page } from "../../ui/Page";
import { BatchState, SweepList } from "../../features/sweep/SweepState";
import { SharedNote } from "../../features/share/SharedBanner";
import { SweepButton } from "../../features/sweep/SweepButton";
import {
  titleOf,
  batchRequirementsQuery,
  cell,
  lowest,
  REQUIRED,
  rowsOf,
  tableQuery,
  type Columns,
  useOpenRun,
} from "../../features/sweep/table";
import {
  useBatchView,
  useSharedView,
  type BatchView,
  CAVEAT_COLUMNS,
  describeRow,
  fieldTexts,
  shownPlot,
  type SweepParts,
} from "./view";
import { ask } from "../../api/http";
import { BatchFiles } from "../../features/export/FileMenu";
import { ShareLink } from "../../features/share/ShareLink";
import { LabLink } from "../../ui/openInLab";
import { keepPreviousData, useQuery } from "@tanstack/react-query";
import { useCallback, useDeferredValue, useEffect, useEffectEvent, useMemo } from "react";
import { type Group, type NumberField } from "../../scenario/schema";
import { BatchRows } from "./SweepRows";
import { paperMetrics, fullName } from "../../server/metrics";
import { useCatalogues } from "../../server/useCatalogues";
import { Fault } from "../../ui/Messages";
import ui from "../../ui/ui.module.css";
import { Card } from "../../ui/Card";
import { MapPlot } from "./MapPlot";
import { PlotTools } from "./PlotTools";
import { PointsPlot } from "./PointsPlot";
import { inShownUnit } from "../../scenario/limits";
import { sweepFields } from "../../scenario/fields";
import { Button } from "@mantine/core";
import { limitText } from "../../features/requirements/judged";
import { DataTable, type Column } from "../../ui/DataTable";
import { ResultMark } from "../../features/requirements/RequirementsCard";

export function SweepPage() {
  const { id } = useParams({ from: "/b/$id" });
  const [view, onView] = useBatchView();
  return <Sweep key={id} {...{ id, view, onView }} />;
}

/** Where a link shows it. */
export function SharedSweep({ batch, link }: { readonly batch: Batch; readonly link: Link }) {
  const [view, onView] = useSharedView(link.view);
  return <Sweep id={batch.id} {...{ link, view, onView }} />;
}

interface Props {
  readonly id: string;
  readonly view: BatchView;
  readonly onView: (change: Partial<BatchView>) => void;
  readonly link?: Link;
}

function Sweep({ id, view, onView, link }: Props) {
  const { job: batch, connected, left } = useJob(BATCH, id, link?.batch ?? undefined);
  return (
    <Page
      title={batch.label ?? (batch.total > 0 ? `Sweep of ${titleOf(batch.fields)}` : "Sweep")}
      above={link && <SharedNote link={link} what="sweep" />}
      tools={
        <>
          <SweepButton batch={batch} />
          <ShareLink
            make={() => ask("post", "/links", { body: { batch_id: batch.id, view: toShare(batch, view) } })}
            obstacle={null}
            opens="It opens this sweep with its plot as it is here, for anyone who has the link. It is read-only."
          />
          <BatchFiles batch={batch} />
        </>
      }
    >
      <BatchState {...{ batch, connected, left }} readOnly={link !== undefined} />
      <BatchResults {...{ batch, view, onView }} />
      {!link && <SweepList current={id} />}
    </Page>
  );
}

/** How it is looked at, without what the page itself chooses. */
function toShare({ fields, strategies }: Batch, { x, hidden, ...view }: BatchView): SharedView {
  const shown = {
    ...view,
    x: x ?? fields[0]?.name ?? null,
    hidden: hidden.filter((id) => strategies.some((each) => each === id)),
  };
  return Object.fromEntries(Object.entries(shown).filter(([, value]) => value !== null));
}

/** All sweeps there are. */
export function SweepsPage() {
  const lead = (
    <>
      Many variants of one scenario, each under the same strategies. <LabLink size="md">The lab</LabLink> starts one
      over the scenario it shows: “Sweep…”, at its top.
    </>
  );
  return (
    <Page title="Sweeps" lead={lead}>
      <SweepList />
    </Page>
  );
}

/** The plot and the rows, and from a row to its run. */
const NOTHING: Columns = {};
const HEIGHT = 400;

function BatchResults({ batch: stored, view, onView }: Pick<SweepParts, "batch" | "view" | "onView">) {
  const { form, catalogue, figures, strategies: all } = useCatalogues();
  const { strategies: ids } = stored;
  const strategies = useMemo(() => all.filter((each) => ids.some((id) => id === each.id)), [all, ids]);
  // Every event is a new batch: what is drawn depends on its fields alone, which stay.
  const { fields: storedFields, sweep } = stored;
  const fields = useMemo(() => shownFields(storedFields, form), [storedFields, form]);
  const batch = useMemo(() => ({ ...stored, fields }), [stored, fields]);
  const shown = useMemo(
    () => shownPlot({ fields, sweep }, strategies, figures, view),
    [fields, sweep, strategies, figures, view],
  );
  const y = shown?.y;
  const plotted = shown && [shown.y.key, ...(shown.kind === "trade_off" ? [shown.versus.key] : [])].join(" ");
  const keys = useMemo(
    () => [...new Set([...(plotted?.split(" ") ?? []), ...paperMetrics(catalogue)])],
    [catalogue, plotted],
  );
  const requested = useMemo(() => [...new Set([...keys, ...CAVEAT_COLUMNS])], [keys]);
  const table = useQuery({ ...tableQuery(batch, requested), placeholderData: keepPreviousData });
  const arrived = table.data?.columns ?? NOTHING;
  // Drawn in pieces: ten thousand rows do not hold the page.
  const fetched = useDeferredValue(arrived, NOTHING);
  const required = useQuery({ ...batchRequirementsQuery(stored), placeholderData: keepPreviousData }).data;
  const columns = useMemo<Columns>(
    () => ({ ...shownColumns(fetched, storedFields, form), ...(required && { [REQUIRED]: required.runs }) }),
    [fetched, storedFields, form, required],
  );
  // The first finished runs are shown as soon as they are known of, not when rows are due again.
  const readFirst = useEffectEvent(() => {
    if (!columns.status?.includes("ok")) void table.refetch();
  });
  const hasStarted = batch.done > 0;
  useEffect(() => {
    if (hasStarted) readFirst();
  }, [hasStarted]);
  const visible = useMemo(() => strategies.filter(({ id }) => !view.hidden.includes(id)), [strategies, view.hidden]);
  const best = useMemo(() => {
    if (!y) return null;
    const rows = rowsOf(columns, (row) => visible.some(({ id }) => id === cell(columns, "strategy", row)));
    return lowest(columns, rows, y.key);
  }, [columns, visible, y]);

  const opening = useOpenRun(batch);
  const open = (row: number) => {
    const values = batch.fields.map(({ name }) => [name, cell(fetched, name, row)] as const);
    opening.open({
      run: row,
      at: Object.fromEntries(values.flatMap(([name, value]) => (value === undefined ? [] : [[name, value]]))),
    });
  };
  const textOf = useCallback(
    (row: number) => (y ? describeRow(row, { columns, fields, strategies, y, catalogue }) : []),
    [columns, fields, strategies, y, catalogue],
  );
  const listed = useMemo(
    () => keys.flatMap((key) => figures.find((figure) => figure.key === key) ?? []),
    [keys, figures],
  );

  if (!shown) return null;
  const common = { batch, columns, strategies, shown, textOf, onOpen: open, height: HEIGHT };
  return (
    <div className={ui.stack} data-testid="batch-results" data-rows={columns.run?.length ?? 0}>
      {table.isError && <Fault size="md">The rows could not be read: {table.error.message}</Fault>}
      {opening.error !== null && <Fault size="md">This run could not be opened: {opening.error}</Fault>}
      <Card aria-label="Plot">
        <PlotTools {...{ strategies, shown, view, onView }} />
        {shown.kind === "map" ? (
          <MapPlot {...common} />
        ) : (
          <PointsPlot key={shown.kind} {...common} {...{ visible, best }} />
        )}
      </Card>
      {required && (
        <BatchRequirements results={required.requirement_results} {...{ columns, fields, strategies }} onOpen={open} />
      )}
      <BatchRows
        {...{ batch, columns, strategies, best }}
        loading={table.isPending || fetched !== arrived}
        figures={listed}
        opening={opening.opening?.run ?? null}
        onOpen={open}
      />
    </div>
  );
}

type Fields = Batch["fields"];

function leavesByName(fields: Fields, form: Group): ReadonlyMap<string, NumberField> {
  const names = new Set(fields.map(({ name }) => name));
  return new Map(
    sweepFields(form).flatMap(({ name, leaf }) =>
      leaf.kind === "number" && names.has(name) ? [[name, leaf] as const] : [],
    ),
  );
}

/** A sweep's fields and their values in the units the form shows them in. */
function shownFields(fields: Fields, form: Group): Fields {
  const leaves = leavesByName(fields, form);
  return fields.map((field) => ({ ...field, unit: leaves.get(field.name)?.shown.unit ?? field.unit }));
}

function shownColumns(columns: Columns, fields: Fields, form: Group): Columns {
  const scaled = [...leavesByName(fields, form)].flatMap(([name, leaf]) => {
    const values = leaf.shown.scale === 1 ? undefined : columns[name];
    return values
      ? [[name, values.map((value) => (typeof value === "number" ? inShownUnit(leaf, value) : value))] as const]
      : [];
  });
  return scaled.length === 0 ? columns : { ...columns, ...Object.fromEntries(scaled) };
}

type Result = Answer["requirement_results"][number];

interface BatchRequirementsProps extends Pick<SweepParts, "columns" | "strategies" | "onOpen"> {
  readonly results: readonly Result[];
  readonly fields: SweepParts["batch"]["fields"];
}

function BatchRequirements({ results, columns, fields, strategies, onOpen }: BatchRequirementsProps) {
  const { figures } = useCatalogues();
  const labelOf = (id: string | null) => strategies.find((each) => each.id === id)?.label ?? id;
  const described: readonly Column<Result>[] = [
    {
      key: "requirement",
      head: "Requirement",
      text: true,
      cell: (result) => {
        const figure = figures.find(({ key }) => key === result.metric);
        return `${figure ? fullName(figure) : result.metric} ${limitText(result, figure, labelOf(result.baseline))}`;
      },
    },
    { key: "strategy", head: "Strategy", text: true, cell: ({ strategy }) => labelOf(strategy) },
    { key: "result", head: "Result", text: true, cell: ({ result }) => <ResultMark result={result} /> },
    { key: "fail", head: "Runs that fail", cell: ({ counts }) => counts.fail },
    { key: "not_computed", head: "Not computed", cell: ({ counts }) => counts.not_computed },
    { key: "unfinished", head: "Unfinished", cell: ({ counts }) => counts.unfinished },
    {
      key: "first",
      head: "First failure",
      text: true,
      cell: ({ first_failure: first }) =>
        first ? (
          <Button size="compact-xs" variant="subtle" onClick={() => onOpen(first.run)}>
            {fieldTexts(columns, first.run, fields).join(", ") || `Run ${first.run}`}
          </Button>
        ) : (
          "–"
        ),
    },
  ];
  return (
    <Card aria-label="Requirements" title="Requirements">
      <DataTable
        label="How the runs keep the requirements"
        columns={described}
        rows={results}
        rowKey={(result) => results.indexOf(result)}
        attributes={{ "data-dense": true }}
      />
    </Card>
  );
}
