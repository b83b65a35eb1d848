/** The way between the pages: links where there is room, else a menu under the name of the page shown. */

import { Button, Menu } from "@mantine/core";
import { IconChevronDown } from "@tabler/icons-react";
import { PAGES, pageAt } from "../pages";
import classes from "./nav.module.css";

interface Props {
  /** The header holds much else: the links make room earlier. */
  readonly crowded?: boolean;
}

const ENTRIES = [{ path: "/", label: "Lab" }, ...PAGES];

export function Nav({ crowded = false }: Props) {
  const { pathname } = window.location;
  // A sweep and a shared result belong to the lab, but are not its start.
  const current = pageAt(pathname) ?? { path: pathname.startsWith("/b/") ? null : "/", label: "Lab" };
  const currentOf = (path: string) => (path === current.path ? "page" : undefined);
  return (
    <nav aria-label="Pages" className={classes.nav} data-crowded={crowded || undefined}>
      <ul className={classes.links}>
        {ENTRIES.map(({ path, label }) => (
          <li key={path}>
            <a href={path} className={classes.link} aria-current={currentOf(path)}>
              {label}
            </a>
          </li>
        ))}
      </ul>
      <Menu position="bottom-start" width={180}>
        <Menu.Target>
          <Button
            size="xs"
            variant="subtle"
            color="gray"
            className={classes.menu ?? ""}
            aria-label={`Pages, now ${current.label}`}
            rightSection={<IconChevronDown size={14} aria-hidden />}
          >
            {current.label}
          </Button>
        </Menu.Target>
        <Menu.Dropdown>
          {ENTRIES.map(({ path, label }) => (
            <Menu.Item key={path} component="a" href={path} aria-current={currentOf(path)} className={classes.item ?? ""}>
              {label}
            </Menu.Item>
          ))}
        </Menu.Dropdown>
      </Menu>
    </nav>
  );
}
