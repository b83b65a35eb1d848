/** The plot and the rows, and from a row to its run. */

import { keepPreviousData, useQuery } from "@tanstack/react-query";
import { useEffect, useEffectEvent, useMemo } from "react";
import type { Group } from "../../scenario/schema";
import { BatchPlot } from "./SweepPlot";
import { BatchRows } from "./SweepRows";
import { paperFigures } from "../../server/metrics";
import { cell, lowest, rowsOf, type Columns } from "../../features/sweep/table";
import { CAVEAT_COLUMNS } from "./describeRow";
import { tableQuery } from "../../features/sweep/queries";
import { useOpenRun } from "../../features/sweep/useOpenRun";
import { shownPlot } from "./shownPlot";
import { shownColumns, shownFields } from "./shownFields";
import { Fault } from "../../ui/Fault";
import ui from "../../ui/ui.module.css";
import type { SweepParts } from "./props";

interface Props extends Pick<
  SweepParts,
  "batch" | "catalogue" | "strategies" | "markers" | "figures" | "view" | "onView"
> {
  readonly form: Group;
}

const NOTHING: Columns = {};

export function BatchResults({ batch: stored, form, catalogue, strategies, markers, figures, view, onView }: Props) {
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
    () => [...new Set([...(plotted?.split(" ") ?? []), ...paperFigures(catalogue)])],
    [catalogue, plotted],
  );
  const requested = useMemo(() => [...new Set([...keys, ...CAVEAT_COLUMNS])], [keys]);
  const table = useQuery({ ...tableQuery(batch, requested), placeholderData: keepPreviousData });
  const fetched = table.data?.columns ?? NOTHING;
  const columns = useMemo(() => shownColumns(fetched, storedFields, form), [fetched, storedFields, form]);
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
    const ids = visible.map(({ id }) => id);
    return lowest(
      columns,
      rowsOf(columns, (row) => ids.includes(String(columns.strategy?.[row]))),
      y.key,
    );
  }, [columns, visible, y]);

  const opening = useOpenRun(batch);
  const open = (row: number) => {
    const values = batch.fields.map(({ name }) => [name, cell(fetched, name, row)] as const);
    opening.open({
      run: row,
      at: Object.fromEntries(values.flatMap(([name, value]) => (value === undefined ? [] : [[name, value]]))),
    });
  };
  const listed = useMemo(
    () => keys.flatMap((key) => figures.find((figure) => figure.key === key) ?? []),
    [keys, figures],
  );

  if (!shown) return null;
  return (
    <div className={ui.stack} data-testid="batch-results" data-rows={columns.run?.length ?? 0}>
      {table.isError && <Fault size="sm">The rows could not be read: {table.error.message}</Fault>}
      {opening.error !== null && <Fault size="sm">This run could not be opened: {opening.error}</Fault>}
      <BatchPlot
        {...{ batch, columns, catalogue, strategies, markers, figures, shown, view, best, onView }}
        onOpen={open}
      />
      <BatchRows
        {...{ batch, columns, catalogue, strategies, markers, best }}
        loading={table.isPending}
        figures={listed}
        opening={opening.opening?.run ?? null}
        onOpen={open}
      />
    </div>
  );
}
