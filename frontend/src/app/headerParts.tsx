/** What of the header follows the first curves: the pages where they have no room side by side, help, colours and logging out. */

import { Box, Button, Menu, useComputedColorScheme, useMantineColorScheme } from "@mantine/core";
import { useMutation, useQuery } from "@tanstack/react-query";
import { Link, type LinkOptions } from "@tanstack/react-router";
import { ask, query } from "../api/http";
import { useActionButton } from "../lab/actions";
import { Hints } from "../ui/Hints";
import { IconButton } from "../ui/IconButton";
import { Icon } from "../ui/icons";
import classes from "./nav.module.css";

interface PagesProps {
  readonly entries: readonly { readonly section: string; readonly label: string; readonly link: LinkOptions }[];
  /** That of the page shown. */
  readonly section: string | undefined;
}

export function PagesMenu({ entries, section }: PagesProps) {
  const help = useActionButton("help");
  const current = entries.find((entry) => entry.section === section);
  return (
    <Menu position="bottom-start" width={180}>
      <Menu.Target>
        <Button
          variant="subtle"
          color="gray"
          className={classes.menu ?? ""}
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
            className={classes.item ?? ""}
            aria-current={entry.section === section ? "page" : undefined}
            renderRoot={(props) => <Link {...link} {...props} />}
          >
            {label}
          </Menu.Item>
        ))}
        <Menu.Divider />
        <Menu.Item className={classes.item ?? ""} onClick={help.onClick}>
          {help.label}
        </Menu.Item>
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
