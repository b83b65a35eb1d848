/** What of the header follows the first curves: the pages where they have no room side by side, help, colours and logging out. */

import { Box, Button, Menu, useComputedColorScheme, useMantineColorScheme, Tooltip } from "@mantine/core";
import { useMutation, useQuery } from "@tanstack/react-query";
import { Link, type LinkOptions } from "@tanstack/react-router";
import { ask, query } from "../api/http";
import { useActionButton } from "../lab/actions";
import { IconButton } from "../ui/IconButton";
import { Icon } from "../ui/icons";
import { useEffect, useState } from "react";
import { createTimer } from "../lib/timer";

interface PagesProps {
  readonly entries: readonly { readonly section: string; readonly label: string; readonly link: LinkOptions }[];
  /** That of the page shown. */
  readonly section: string | undefined;
  readonly hiddenFrom: "lg" | "sm";
}

export function PagesMenu({ entries, section, hiddenFrom }: PagesProps) {
  const help = useActionButton("help");
  const current = entries.find((entry) => entry.section === section);
  return (
    <Menu position="bottom-start" width={180}>
      <Menu.Target>
        <Button
          variant="subtle"
          color="gray"
          px="0.4rem"
          c="var(--text)"
          {...{ hiddenFrom }}
          aria-label={`Pages, now ${current?.label ?? "another"}`}
          rightSection={<Icon name="ChevronDown" size={14} />}
        >
          {current?.label ?? "Pages"}
        </Button>
      </Menu.Target>
      <Menu.Dropdown>
        {entries.map(({ label, link, ...entry }) => (
          <Menu.Item
            key={label}
            {...(entry.section === section && { "aria-current": "page" as const, fw: 650 })}
            renderRoot={(props) => <Link {...link} {...props} />}
          >
            {label}
          </Menu.Item>
        ))}
        <Menu.Divider />
        <Menu.Item onClick={help.onClick}>{help.label}</Menu.Item>
      </Menu.Dropdown>
    </Menu>
  );
}

/** The end of every header: help, the switch between light and dark colours, the log-out where there is a login; the page's hints too. */
export function HeaderEnd() {
  const { setColorScheme } = useMantineColorScheme();
  const isDark = useComputedColorScheme("light") === "dark";
  const next = isDark ? "light" : "dark";
  const name = useQuery({ ...query("/login", {}), staleTime: Infinity }).data?.name ?? null;
  const logOut = useMutation({
    mutationFn: () => ask("delete", "/login", {}),
    onSuccess: () => window.location.reload(),
  });
  return (
    <>
      <Box component="span" visibleFrom="sm">
        <IconButton {...useActionButton("help")}>
          <Icon name="Help" size={18} stroke={1.7} />
        </IconButton>
      </Box>
      <IconButton label={`Use ${next} colours`} onClick={() => setColorScheme(next)}>
        {isDark ? <Icon name="Sun" size={18} stroke={1.7} /> : <Icon name="Moon" size={18} stroke={1.7} />}
      </IconButton>
      {name !== null && (
        <IconButton
          label={logOut.error?.message ?? `Log out ${name}`}
          disabled={logOut.isPending}
          onClick={() => logOut.mutate()}
        >
          <Icon name="Logout" size={18} stroke={1.7} />
        </IconButton>
      )}
      <Hints />
    </>
  );
}

/** Pointed at for so long [ms]. */
const DELAY_MS = 300;

const hintedAt = ({ target }: Event) => (target instanceof Element ? target.closest<HTMLElement>("[data-hint]") : null);

/**
 * The page's one tooltip: it shows the `data-hint` of the element that is pointed at or reached by key.
 * A tooltip for each element would make the page slower to open.
 */
export function Hints() {
  const [shown, setShown] = useState<HTMLElement | null>(null);
  const [text, setText] = useState<string>();
  useEffect(() => {
    let next: HTMLElement | null = null;
    const timer = createTimer(DELAY_MS, () => {
      setShown(next?.isConnected ? next : null);
      setText(next?.dataset.hint);
    });
    const turnTo = (element: HTMLElement | null) => {
      if (element === next) return;
      next = element;
      setShown(null);
      if (element) timer.start();
      else timer.stop();
    };
    const listening = new AbortController();
    const { signal } = listening;
    // A tap does what an element is for; one that has `data-hint-only` is there for its hint.
    const point = (event: PointerEvent) => {
      const hinted = hintedAt(event);
      turnTo(event.pointerType === "mouse" || hinted?.hasAttribute("data-hint-only") ? hinted : null);
    };
    const focus = (event: FocusEvent) => {
      const hinted = hintedAt(event);
      if (hinted !== next) turnTo(hinted?.matches(":focus-visible") ? hinted : null);
    };
    const blur = (event: FocusEvent) => {
      if (hintedAt(event) === next) turnTo(null);
    };
    // A finger leaves the page whenever it is lifted.
    const leave = (event: PointerEvent) => {
      if (event.pointerType === "mouse") turnTo(null);
    };
    const end = (event: KeyboardEvent) => {
      if (event.key === "Escape") turnTo(null);
    };
    document.addEventListener("pointerover", point, { signal });
    document.addEventListener("focusin", focus, { signal });
    document.addEventListener("focusout", blur, { signal });
    document.documentElement.addEventListener("pointerleave", leave, { signal });
    document.addEventListener("keydown", end, { signal, capture: true });
    return () => {
      timer.stop();
      listening.abort();
    };
  }, []);
  useEffect(() => {
    if (!shown) return undefined;
    const isSaid = shown.hasAttribute("aria-description") || shown.ariaLabel === shown.dataset.hint;
    if (!isSaid) shown.setAttribute("aria-description", shown.dataset.hint ?? "");
    const changes = new MutationObserver(() => (shown.isConnected ? setText(shown.dataset.hint) : setShown(null)));
    changes.observe(shown, { attributeFilter: ["data-hint"] });
    changes.observe(document.body, { childList: true, subtree: true });
    return () => {
      changes.disconnect();
      if (!isSaid) shown.removeAttribute("aria-description");
    };
  }, [shown]);
  return (
    shown &&
    text !== undefined && (
      <Tooltip
        opened
        target={shown}
        label={text}
        multiline
        maw={280}
        withArrow
        styles={{ tooltip: { whiteSpace: "pre-line" } }}
      />
    )
  );
}
