/** The places of what is on its way. */

import { Skeleton } from "@mantine/core";
import ui from "./ui.module.css";

export function Loading({ label, heights }: { readonly label: string; readonly heights: readonly number[] }) {
  return (
    <div className={ui.stack} aria-busy aria-label={label}>
      {heights.map((height, index) => (
        <Skeleton key={index} height={height} radius={8} />
      ))}
    </div>
  );
}
