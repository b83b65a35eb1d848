/** A line as the plots draw it: colour, width, dash. */

interface Props {
  readonly colour?: string;
  readonly width?: number;
  /** As SVG writes it. */
  readonly dash?: string | undefined;
}

export function LineKey({ colour = "currentColor", width = 2.5, dash = "none" }: Props) {
  return (
    <svg width="24" height="10" viewBox="0 0 24 10" aria-hidden style={{ flex: "none" }}>
      <line x1="1" x2="23" y1="5" y2="5" stroke={colour} strokeWidth={width} strokeDasharray={dash} />
    </svg>
  );
}
