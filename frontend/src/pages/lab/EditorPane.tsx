/** The form: beside the results where there is room, else in a sheet that leaves the plots in sight. */

import { Button, Drawer, Stack, Skeleton } from "@mantine/core";
import { useDisclosure, useMediaQuery } from "@mantine/hooks";
import { IconAdjustmentsHorizontal } from "../../ui/icons";
import { Editor } from "../../features/editor/Editor";
import type { Group } from "../../scenario/schema";
import { useReadOnly } from "../../lab/context";
import { revealed } from "../../lab/reveal";
import { useStore } from "../../lib/store";
import classes from "../../ui/shell.module.css";

export function EditorPane({ form }: { readonly form: Group | undefined }) {
  const narrow = useMediaQuery("(max-width: 47.99em)", false, { getInitialValueInEffect: false });
  const readOnly = useReadOnly();
  const [opened, { open, close }] = useDisclosure(false);
  const isSought = useStore(revealed) !== null;
  if (narrow && isSought && !opened) open();
  const content = form ? <Editor form={form} /> : <EditorLoading />;
  if (!narrow) {
    return (
      <aside className={classes.aside} aria-label="Scenario">
        {content}
      </aside>
    );
  }
  return (
    <>
      <Button className={classes.editButton ?? ""} leftSection={<IconAdjustmentsHorizontal size={18} />} onClick={open}>
        {readOnly ? "Scenario" : "Edit scenario"}
      </Button>
      <Drawer
        opened={opened}
        onClose={close}
        position="bottom"
        size="52%"
        title="Scenario"
        withOverlay={false}
        lockScroll={false}
        trapFocus={false}
        closeOnClickOutside={false}
        classNames={{ content: classes.sheet ?? "", header: classes.sheetHeader ?? "", body: classes.sheetBody ?? "" }}
        closeButtonProps={{ "aria-label": "Close the form" }}
      >
        {content}
      </Drawer>
    </>
  );
}

export function EditorLoading() {
  return (
    <Stack gap="0.9rem" p="1.2rem 1rem" aria-busy aria-label="Loading the form">
      {Array.from({ length: 9 }, (_, index) => (
        <Skeleton key={index} height={index % 4 === 0 ? 18 : 44} width={index % 4 === 0 ? "45%" : "100%"} radius="sm" />
      ))}
    </Stack>
  );
}
