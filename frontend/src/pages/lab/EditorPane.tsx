/** The form: beside the results where there is room, else in a sheet that leaves the plots in sight. */

import { Button, Drawer } from "@mantine/core";
import { useDisclosure, useMediaQuery } from "@mantine/hooks";
import { Icon } from "../../ui/icons";
import { Editor } from "../../features/editor/Editor";
import { useLabContext, useReadOnly } from "../../lab/context";
import { useFigures, useForm } from "../../server/useCatalogues";
import { useSelector } from "@tanstack/react-store";
import { useEffect } from "react";
import classes from "../../ui/shell.module.css";
import { revealed } from "../../lab/actions";

/** Signals the moving car needs besides those in the figures. */
const CAR_SIGNALS = ["rear_road"];

const SHEET = {
  borderTop: "1px solid var(--line)",
  background: "var(--surface)",
  boxShadow: "0 -4px 24px rgb(0 0 0 / 18%)",
};

export function EditorPane() {
  const { lab } = useLabContext();
  const [form, figures] = [useForm(), useFigures()];
  // Before the form's first edit, so that what is refused is marked at its field.
  useEffect(() => {
    const drawn = Object.values(figures).flatMap(({ data }) => data.map(({ meta }) => meta.signal));
    lab.configure(form, [...new Set([...drawn, ...CAR_SIGNALS])]);
  }, [lab, form, figures]);
  const narrow = useMediaQuery("(max-width: 47.99em)", false, { getInitialValueInEffect: false });
  const readOnly = useReadOnly();
  const [opened, { open, close }] = useDisclosure(false);
  const isSought = useSelector(revealed) !== null;
  if (narrow && isSought && !opened) open();
  const content = <Editor form={form} />;
  if (!narrow) {
    return (
      <aside className={classes.aside} data-unprinted aria-label="Scenario">
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
        data-unprinted
        pos="fixed"
        right="1rem"
        bottom="1rem"
        style={{ zIndex: 40, boxShadow: "0 4px 16px rgb(0 0 0 / 25%)" }}
        leftSection={<Icon name="AdjustmentsHorizontal" size={18} />}
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
        styles={{
          content: SHEET,
          header: { minHeight: "2.75rem", padding: "0.25rem 1rem", background: "inherit" },
          body: { padding: 0 },
        }}
        attributes={{ header: { role: "none" } }} // the page's own is the banner
        closeButtonProps={{ "aria-label": "Close the form" }}
      >
        {content}
      </Drawer>
    </>
  );
}
