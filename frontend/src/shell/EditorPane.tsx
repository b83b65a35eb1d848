/** The form: beside the results where there is room, else in a sheet that leaves the plots in sight. */

import { Button, Drawer } from "@mantine/core";
import { useDisclosure, useMediaQuery } from "@mantine/hooks";
import { IconAdjustmentsHorizontal } from "../icons";
import { Editor } from "../editor/Editor";
import type { Group } from "../editor/schema";
import { useReadOnly } from "../state/context";
import { revealed } from "../state/reveal";
import { useStore } from "../state/store";
import { EditorLoading } from "./Blank";
import classes from "./shell.module.css";

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
