/** Width, type size and format of one figure's file. */

import { Button, Group, Popover, SegmentedControl, Stack, Text } from "@mantine/core";
import { useMediaQuery } from "@mantine/hooks";
import { useId, useState, type ReactNode } from "react";
import { download } from "../lib/download";
import { figureImage, FONT_SIZES, WIDTHS, type FontSize, type Width } from "./paperFigure";
import type { FigureSource } from "./saved";

interface Props {
  readonly source: FigureSource;
  readonly opened: boolean;
  readonly onChange: (opened: boolean) => void;
  readonly children: ReactNode;
}

export function FigureMenu({ source, opened, onChange, children }: Props) {
  const [width, setWidth] = useState<Width>("88");
  const [font, setFont] = useState<FontSize>("8");
  const [failed, setFailed] = useState(false);
  const id = useId();
  const isNarrow = useMediaQuery("(max-width: 30em)", false, { getInitialValueInEffect: false });
  const { title, file, paper } = source;
  const save = (suffix: string, make: () => Promise<string>) => {
    setFailed(false);
    make().then(
      (address) => {
        download(address, `${file}.${suffix}`);
        onChange(false);
      },
      () => setFailed(true),
    );
  };
  const image = async (format: "png" | "svg") =>
    figureImage(await paper({ width: Number(width), font: Number(font) }), format);
  const csv = async () => `data:text/csv;charset=utf-8,${encodeURIComponent(await source.csv())}`;
  return (
    <Popover
      opened={opened}
      onChange={onChange}
      position="bottom-end"
      trapFocus
      returnFocus
      withRoles={false}
      shadow="md"
    >
      <Popover.Target>{children}</Popover.Target>
      <Popover.Dropdown role="dialog" aria-label={`Save figure: ${title}`} maw="calc(100vw - 1rem)">
        <Stack gap="xs">
          <Text size="xs" fw={600} id={`${id}-width`}>
            Width
          </Text>
          <SegmentedControl
            aria-labelledby={`${id}-width`}
            orientation={isNarrow ? "vertical" : "horizontal"}
            value={width}
            data={[...WIDTHS]}
            onChange={setWidth}
          />
          <Text size="xs" fw={600} id={`${id}-font`}>
            Font size
          </Text>
          <SegmentedControl aria-labelledby={`${id}-font`} value={font} data={FONT_SIZES} onChange={setFont} />
          <Group gap="xs" wrap="nowrap">
            <Button onClick={() => save("png", () => image("png"))}>PNG, 300 dpi</Button>
            <Button onClick={() => save("svg", () => image("svg"))}>SVG</Button>
            <Button onClick={() => save("csv", csv)}>CSV</Button>
          </Group>
          {failed && (
            <Text size="xs" role="alert">
              The drawing program could not be loaded. Try again.
            </Text>
          )}
        </Stack>
      </Popover.Dropdown>
    </Popover>
  );
}
