/** The dragged side of a number: live while it moves, exact once it rests. */

import { Slider } from "@mantine/core";
import { useRef } from "react";
import { formatWithUnit } from "../../units/format";
import classes from "./editor.module.css";
import { inShownUnit, sliderScale } from "../../scenario/limits";
import type { NumberField } from "../../scenario/schema";
import { useKeyRest } from "./useKeyRest";
import type { LeafState } from "./useLeaf";

interface Props {
  readonly field: NumberField;
  readonly leaf: LeafState;
  readonly label: string;
}

export function NumberSlider({ field, leaf, label }: Props) {
  const scale = sliderScale(field);
  const byKey = useRef(false);
  const rest = useKeyRest(leaf.release);

  const clamp = (value: number) => Math.min(scale.maximum, Math.max(scale.minimum, scale.toSlider(value)));
  const value = typeof leaf.value === "number" ? clamp(leaf.value) : scale.minimum;
  const standard = typeof field.standard === "number" ? scale.toSlider(field.standard) : null;
  const marked = standard !== null && standard >= scale.minimum && standard <= scale.maximum;
  const spoken =
    typeof leaf.value === "number" ? formatWithUnit(inShownUnit(field, leaf.value), field.shown.unit, 4) : "";

  return (
    <div onKeyDownCapture={() => (byKey.current = true)} onPointerDownCapture={() => (byKey.current = false)}>
      <Slider
        className={classes.slider ?? ""}
        classNames={{ thumb: classes.thumb ?? "", mark: classes.mark ?? "", bar: classes.bar ?? "" }}
        size={4}
        label={null}
        min={scale.minimum}
        max={scale.maximum}
        step={1}
        precision={0}
        value={value}
        disabled={leaf.readOnly}
        thumbLabel={label}
        thumbValueText={spoken}
        {...(marked ? { marks: [{ value: standard }], startPointValue: standard } : {})}
        onChange={(position) => {
          const next = scale.fromSlider(position);
          if (next !== leaf.value) leaf.drag(next);
        }}
        onChangeEnd={() => {
          rest.stop();
          if (byKey.current) rest.begin();
          else leaf.release();
        }}
      />
    </div>
  );
}
