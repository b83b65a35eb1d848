/** A measured road in place of a made one: of the library, or opened from a file; drawn, with the bump that counts; and saved as a file. */

import { Button, Text, Box } from "@mantine/core";
import { useQuery } from "@tanstack/react-query";
import { address } from "../../api/http";
import { useOpenItem } from "../library/open";
import { OpenFiles } from "../library/OpenFiles";
import { ProfileSketch, SKETCH } from "../library/ProfileSketch";
import { useItems } from "../../scenario/library";
import { useEdit, useFromScenario } from "../../lab/context";
import { roadQuery } from "../../server/queries";
import { FieldFrame, useLeaf } from "./FieldFrame";
import { getAt, setAt } from "../../scenario/path";
import { onBump } from "../../scenario/withItem";
import type { TextField } from "../../scenario/schema";
import { useElementSize } from "@mantine/hooks";
import type { MeasuredRoad } from "../../api/types";
import { formatNumber } from "../../units/format";
import { Caution } from "../../ui/Caution";
import { Choice } from "../../ui/Entry";

const NONE = { value: "", label: "None" };
const FORMATS = [
  { format: "csv", name: "CSV" },
  { format: "crg", name: "OpenCRG" },
] as const;

export function RoadProfileRow({ field }: { readonly field: TextField }) {
  const leaf = useLeaf(field);
  const edit = useEdit();
  const openItem = useOpenItem();
  const own = useItems("road");
  const id = typeof leaf.value === "string" ? leaf.value : "";
  const road = useQuery(roadQuery(id)).data;
  const bumps = road?.bumps ?? [];
  const labels = bumps.map(
    ({ start, width, height }) => `${(1000 * height).toFixed(0)} mm at ${start} m over ${width} m`,
  );
  const place = useFromScenario((scenario) => getAt(scenario, "/road/bump/start"));
  const counting = bumps.findIndex(({ start }) => Math.max(1, start) === place);
  const saved = own.flatMap(({ name, value }) =>
    typeof value.id === "string" ? [{ value: value.id, label: name }] : [],
  );
  const name = `profile-${field.pointer}`;

  const choose = (value: string) => {
    const item = own.find((each) => each.value.id === value);
    if (item) openItem(item);
    else if (value === "") edit.commit(setAt(edit.newest(), field.pointer, null));
  };

  return (
    <FieldFrame
      id={name}
      {...{ field, leaf }}
      paperText="none"
      aside={
        <>
          {road &&
            FORMATS.map(({ format, name: called }) => (
              <Button
                key={format}
                component="a"
                size="compact-xs"
                href={address("/roads/{id}", { path: { id }, query: { format } })}
                download={`ridelab-road-${id}.${format}`}
              >
                Save {called}
              </Button>
            ))}
          {!leaf.readOnly && <OpenFiles name="Road file">Open file</OpenFiles>}
        </>
      }
    >
      {(own.length > 0 || id !== "") && (
        <Choice
          id={name}
          value={id}
          disabled={leaf.readOnly}
          data={[
            NONE,
            ...(id === "" || saved.some(({ value }) => value === id)
              ? []
              : [{ value: id, label: "A measured road, not in the library" }]),
            ...(saved.length > 0 ? [{ group: "Your measured roads", items: saved }] : []),
          ]}
          onPick={choose}
        />
      )}
      {road && (
        <>
          <ProfileSketch
            label="The road that is driven"
            distance={road.distance}
            tracks={[road.height]}
            marks={bumps.map((bump, index) => ({ ...bump, counts: index === counting }))}
          />
          <Text size="xs" mt={4} c="dimmed">
            {road.length} m measured, in place of roughness and seed.{" "}
            {labels.length > 0 ? `Bumps in it: ${labels.join(", ")}.` : "No bump was found in it."}
          </Text>
          {road.cautions.map(({ kind, text }) => (
            <Caution key={kind} text={text} />
          ))}
          {bumps.length > 1 && (
            <Choice
              label="Bump that counts"
              description="The car brakes for it, and the stages and windows go by it."
              value={counting}
              disabled={leaf.readOnly}
              data={[
                ...(counting < 0 ? [{ value: "-1", label: "None of them" }] : []),
                ...labels.map((label, index) => ({ value: String(index), label })),
              ]}
              onPick={(value) => {
                const bump = bumps[Number(value)];
                if (bump) edit.commit(onBump(edit.newest(), road.length, bump));
              }}
            />
          )}
          {indicesText(road) !== null && (
            <>
              <RoadSpectrum road={road} />
              <Text size="xs" mt={4} c="dimmed">
                {indicesText(road)}
              </Text>
            </>
          )}
        </>
      )}
    </FieldFrame>
  );
}

type Analysis = Pick<MeasuredRoad, "iri" | "iso_class" | "roughness" | "waviness" | "spectrum">;

/** The classes' first limit, of A and B at 0.1 1/m [m³]; each further one is four times as high. */
const FIRST_LIMIT = 32e-6;
const CLASSES = ["A", "B", "C", "D", "E", "F", "G", "H"] as const;
const [LOW, HIGH] = [0.011, 2.83];
const [HEIGHT, FOOT] = [150, 16];

const range = ({ low, high }: { readonly low: number; readonly high: number }, scale = 1) =>
  `${formatNumber(scale * low)} to ${formatNumber(scale * high)}`;

/** `null` where nothing is known of it. */
function indicesText({ iri, iso_class, roughness, waviness }: Analysis): string | null {
  if (!iri) return null;
  const [left, right] = iri.tracks.map((each) => formatNumber(each));
  const index = `IRI ${formatNumber(iri.mean)} m/km${right === undefined ? "" : ` (left ${left}, right ${right})`}.`;
  if (!iso_class || !roughness || !waviness) return index;
  const rough = `${formatNumber(1e6 * roughness.value)} (${range(roughness, 1e6)}) × 10⁻⁶ m³`;
  return `${index} ISO 8608 class ${iso_class}: roughness ${rough}, waviness ${formatNumber(waviness.value)} (${range(waviness)}); 95 % intervals in brackets.`;
}

function RoadSpectrum({ road: { spectrum, roughness, waviness } }: { readonly road: Analysis }) {
  const { ref, width } = useElementSize<HTMLDivElement>();
  if (!spectrum || !roughness || !waviness) return null;
  const line = (level: number, slope: number) => (n: number) => level * (n / 0.1) ** -slope;
  const fit = line(roughness.value, waviness.value);
  const densities = [...spectrum.density, fit(LOW), fit(HIGH)].map(Math.log10);
  const [bottom, top] = [Math.min(...densities) - 0.3, Math.max(...densities) + 0.3];
  const x = (n: number) => (Math.log(n / LOW) / Math.log(HIGH / LOW)) * width;
  const y = (density: number) => ((top - Math.log10(density)) / (top - bottom)) * (HEIGHT - FOOT);
  const points = (of: readonly (readonly [number, number])[]) =>
    of.map(([n, density]) => `${x(n).toFixed(1)},${y(density).toFixed(1)}`).join(" ");
  const straight = (at: (n: number) => number) => points([LOW, HIGH].map((n) => [n, at(n)] as const));
  return (
    <Box ref={ref} mih={HEIGHT}>
      {width > 0 && (
        <svg
          width={width}
          height={HEIGHT}
          style={SKETCH}
          role="img"
          aria-label="Displacement PSD over the road classes of ISO 8608"
        >
          <svg width={width} height={HEIGHT - FOOT}>
            {CLASSES.map((name, index) => {
              const limit = line(FIRST_LIMIT * 4 ** index, 2);
              const middle = 0.1 * Math.sqrt((FIRST_LIMIT * 4 ** (index - 0.5)) / 10 ** ((top + bottom) / 2));
              return (
                <g key={name}>
                  {name !== "H" && <polyline points={straight(limit)} stroke="var(--line)" />}
                  <text x={x(middle)} y={(HEIGHT - FOOT) / 2} textAnchor="middle">
                    {middle > 1.1 * LOW && middle < 0.9 * HIGH ? name : ""}
                  </text>
                </g>
              );
            })}
            <polyline points={straight(fit)} fill="none" stroke="var(--accent)" strokeWidth={1.2} />
            <polyline
              fill="none"
              stroke="var(--text)"
              strokeWidth={1.2}
              points={points(spectrum.frequency.map((n, index) => [n, spectrum.density[index] ?? NaN] as const))}
            />
          </svg>
          <text x={width} y={10} textAnchor="end">
            smoothed PSD, classes A to H
          </text>
          {[0.02, 0.1, 1].map((n) => (
            <text key={n} x={x(n)} y={HEIGHT - 3} textAnchor="middle">
              {n === 1 ? "1 cycle/m" : n}
            </text>
          ))}
        </svg>
      )}
    </Box>
  );
}
