/** The road under a car, and dashed over it where the controller believes it to be. */

import { useId, useMemo, type ReactNode } from "react";
import { HEIGHT, type DrawnCar, type RoadPart, type SeenRoad } from "./geometry";

interface UnderProps {
  readonly part: RoadPart;
  readonly car: DrawnCar;
  readonly width: number;
  readonly children: ReactNode;
}

/** Clips a part of the road that is under one axle alone at the car’s middle. */
export function Under({ part: { under }, car: { front, rear }, width, children }: UnderProps) {
  const id = useId();
  if (under === "car") return children;
  const middle = (front.x + rear.x) / 2;
  const [x, across] = under === "rear" ? [0, middle] : [middle, width - middle];
  return (
    <>
      <clipPath id={id}>
        <rect x={x} y={-HEIGHT} width={Math.max(0, across)} height={4 * HEIGHT} />
      </clipPath>
      <g clipPath={`url(#${id})`} data-road={under}>
        {children}
      </g>
    </>
  );
}

interface RoadProps {
  readonly part: RoadPart;
  readonly colour: string;
  readonly metre: number;
  readonly rise: number;
  readonly seen: SeenRoad | null;
}

/** The road, and dashed over it where the controller believes it to be. */
export function Road({ part: { points: profile }, colour, metre, rise, seen }: RoadProps) {
  const [points, road] = useMemo(() => {
    const line = profile.map(([x, z]) => `${(x * metre).toFixed(1)},${(-z * rise).toFixed(2)}`).join(" ");
    const [start, end] = [profile[0]?.[0] ?? 0, profile.at(-1)?.[0] ?? 0];
    const drawn = (
      <>
        <polygon
          points={`${start * metre},${3 * HEIGHT} ${line} ${end * metre},${3 * HEIGHT}`}
          fill="var(--line)"
          fillOpacity={0.55}
        />
        <polyline points={line} fill="none" stroke="var(--muted)" strokeWidth={2} strokeLinejoin="round" />
      </>
    );
    return [line, drawn] as const;
  }, [profile, metre, rise]);
  return (
    <>
      {road}
      {seen && (
        <polyline
          data-seen
          points={points}
          transform={`translate(${seen.shift * metre} 0) scale(1 ${seen.gain})`}
          fill="none"
          stroke={colour}
          strokeWidth={1.6}
          strokeDasharray="5 4"
          vectorEffect="non-scaling-stroke"
        />
      )}
    </>
  );
}
