/** The form: beside the results where there is room, else in a sheet that leaves the plots in sight. */

import { Button, Drawer } from "@mantine/core";
import { useDisclosure, useMediaQuery } from "@mantine/hooks";
import { IconAdjustmentsHorizontal } from "../../ui/icons";
import { Editor } from "../../features/editor/Editor";
import { useReadOnly } from "../../lab/context";
import { revealed } from "../../lab/reveal";
import { useForm } from "../../server/useCatalogues";
import { useSelector } from "@tanstack/react-store";
import classes from "../../ui/shell.module.css";

export function EditorPane() {
  const form = useForm();
  const narrow = useMediaQuery("(max-width: 47.99em)", false, { getInitialValueInEffect: false });
  const readOnly = useReadOnly();
  const [opened, { open, close }] = useDisclosure(false);
  const isSought = useSelector(revealed) !== null;
  if (narrow && isSought && !opened) open();
  const content = <Editor form={form} />;
  if (!narrow) {
    return (
      <aside className={classes.aside} aria-label="Scenario">
        {content}
      </aside>
    );
  }
  return (
    <>
      <Button
        size="sm"
        variant="filled"
        data-tour="edit"
        className={classes.editButton ?? ""}
        leftSection={<IconAdjustmentsHorizontal size={18} />}
        onClick={open}
      >
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
