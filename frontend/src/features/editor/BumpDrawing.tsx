/** The bump as the wheels meet it, drawn while it is edited, with the form's height and width. */

import { Text } from "@mantine/core";
import { useElementSize } from "@mantine/hooks";
import { useQuery } from "@tanstack/react-query";
import { useFromScenario, useLab } from "../../lab/context";
import { DETAIL_POINTS, seriesQuery } from "../../server/queries";
import { valueText } from "../../scenario/limits";
import { getAt, numberAt, sameValue } from "../../scenario/path";
import type { Member, NumberField } from "../../scenario/schema";
import type { Scenario } from "../../api/types";
import type { Series } from "../../api/decode";
import { covering, valueAt } from "../../lib/samples";

/** Room for the profile, over it and down to the lower end of the labels under it [px]. */
const [ROOM, TOP] = [54, 18];
const FLOOR = TOP + ROOM + 24;

const ROAD = "/road";

export function BumpDrawing({ members }: { readonly members: readonly Member[] }) {
  const road = useFromScenario((scenario) => getAt(scenario, ROAD) ?? null);
  const idle = useLab((state) => state.strategies.length === 0);
  // Without strategies nothing is computed: what was shown last may be of another road.
  const shown = useLab((state) => (idle && !sameValue(getAt(state.shown?.scenario, ROAD), road) ? null : state.shown));
  const [strategy = "", series = {}] = Object.entries(shown?.series ?? {})[0] ?? []; // the road is every strategy's
  const drawn = shown && bumpSketch(shown.scenario, series);
  const driven = shown?.scenario ?? { road };
  const height = getAt(driven, "/road/bump/height");
  const isCoarse = drawn === null && height !== 0 && strategy !== "";
  const run = shown?.runId ?? "";
  const fine = useQuery({ ...seriesQuery(run, [strategy], DETAIL_POINTS), enabled: isCoarse && run !== "" }).data?.[
    strategy
  ];
  const sketch = isCoarse && shown && fine ? bumpSketch(shown.scenario, fine) : drawn;

  const field = (name: string) =>
    members.find(
      (member): member is NumberField => member.kind === "number" && member.pointer === `/road/bump/${name}`,
    );
  const [heightField, widthField] = [field("height"), field("width")];
  if (!heightField || !widthField) return null; // the form is searched for something else
  if (sketch)
    return (
      <Drawing
        sketch={sketch}
        height={valueText(heightField, sketch.height)}
        width={valueText(widthField, sketch.width)}
      />
    );
  if (height !== 0 && !idle) return <div style={{ height: FLOOR }} />; // on its way
  return (
    <Text size="xs" mt={4} c="dimmed">
      {height !== 0
        ? "The bump is drawn as soon as a strategy is shown."
        : getAt(driven, "/road/profile")
          ? "No bump is added to the measured road."
          : "Height 0: there is no bump."}
    </Text>
  );
}

interface Props {
  readonly sketch: BumpSketch;
  readonly height: string;
  readonly width: string;
}

function Drawing({ sketch: { points, ...bump }, height, width }: Props) {
  const { ref, width: pixels } = useElementSize<HTMLDivElement>();
  const heights = points.map(([, z]) => z);
  const [low, high] = [Math.min(0, ...heights), Math.max(0, ...heights)];
  const [from, to] = [points[0]?.[0] ?? 0, points.at(-1)?.[0] ?? 1];
  const metre = Math.min(pixels / (to - from), ROOM / (high - low));
  const factor = exaggeration((high - low) * metre, ROOM);
  const x = (distance: number) => pixels / 2 + (distance - (from + to) / 2) * metre;
  const y = (z: number) => TOP + ROOM + (low - z) * factor * metre;
  const outline = points.map(([distance, z]) => `${x(distance).toFixed(1)},${y(z).toFixed(1)}`).join(" ");
  const [left, right, beside] = [x(0), x(bump.width), x(0) - 7];
  const scale = factor === 1 ? "to scale" : `heights × ${factor}`;
  const several =
    bump.count === 1
      ? ""
      : bump.drawn === bump.count
        ? `${bump.count} bumps, `
        : `first ${bump.drawn} of ${bump.count} bumps, `;
  return (
    <div ref={ref} style={{ height: FLOOR }}>
      {pixels > 0 && (
        <svg
          width={pixels}
          height={FLOOR}
          display="block"
          fontSize="var(--mantine-font-size-xs)"
          fill="var(--text)"
          role="img"
          aria-label={`Bump of height ${height} and width ${width}, ${several}${scale}`}
        >
          <polygon points={`${x(from)},${FLOOR} ${outline} ${x(to)},${FLOOR}`} fill="var(--raised)" />
          <polyline points={outline} fill="none" stroke="var(--text)" strokeWidth={1.5} />
          <path
            d={`M ${beside - 3} ${y(0)} h 6 M ${beside} ${y(0)} V ${y(bump.height)} m -3 0 h 6`}
            stroke="var(--accent)"
          />
          <text x={beside - 5} y={(y(0) + y(bump.height)) / 2} dominantBaseline="middle" textAnchor="end">
            {height}
          </text>
          <path d={`M ${left} ${FLOOR - 19} v 6 m 0 -3 H ${right} m 0 -3 v 6`} fill="none" stroke="var(--accent)" />
          <text x={(left + right) / 2} y={FLOOR - 3} textAnchor="middle">
            {width}
          </text>
          <text x={pixels} y={TOP - 6} textAnchor="end" fill="var(--muted)">
            {several}
            {scale}
          </text>
        </svg>
      )}
    </div>
  );
}

/** The bump's outline from the road a run has driven: the formulas of its shapes are the simulation's. */
interface BumpSketch {
  /** Distance from where the bump begins [m], and height over the road there [m]. */
  readonly points: readonly (readonly [number, number])[];
  readonly width: number;
  readonly height: number;
  /** How many of the bumps are drawn. */
  readonly drawn: number;
  readonly count: number;
}

/** More of them would be narrower than a line. */
const MOST_DRAWN = 6;
/** What is shown beside the bumps, as a part of their length. */
const MARGIN = 0.3;
/** Fewer samples of a bump are no outline. */
const LEAST_SAMPLES = 12;

/** `null` where no bump is added, or the run's samples are too few to draw one. */
export function bumpSketch(scenario: Scenario, { position, front_road: road }: Series): BumpSketch | null {
  const read = (name: string) => numberAt(scenario, `/road/bump/${name}`, 0);
  const [start, width, height] = [read("start"), read("width"), read("height")];
  const [count, spacing] = [read("count"), read("spacing")];
  if (height === 0 || !position || !road) return null;
  const drawn = Math.min(count, MOST_DRAWN);
  const length = (drawn - 1) * spacing + width;
  const [from, to] = covering(position, start - MARGIN * length, start + (1 + MARGIN) * length);
  if (to - from < LEAST_SAMPLES * drawn) return null;
  const ground = valueAt(position, road, start) ?? 0;
  const points = Array.from(
    position.slice(from, to),
    (x, index) => [x - start, (road[from + index] ?? ground) - ground] as const,
  );
  return { points, width, height, drawn, count };
}

/** Of heights; the largest that leaves them lower than `room`. */
export function exaggeration(rise: number, room: number): number {
  return [50, 20, 10, 5, 2].find((factor) => factor * rise <= room) ?? 1;
}
