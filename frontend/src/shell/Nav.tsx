/** Navigation between the pages: links where there is room, else a menu under the name of the page shown. */

import { Button, Menu } from "@mantine/core";
import { IconChevronDown } from "../icons";
import { PAGES, pageAt, type Page } from "../pages";
import classes from "./nav.module.css";

interface Props {
  /** The header holds much else: the links make room earlier. */
  readonly crowded?: boolean;
  /** The run whose scenario this page works on: pages that take one get it, and the lab shows it again. */
  readonly run?: string | null;
}

const LAB = { path: "/", label: "Lab" } as const;

function addressOf({ path, takesRun }: Pick<Page, "path" | "takesRun">, run: string | null): string {
  if (run === null) return path;
  if (path === LAB.path) return `/r/${encodeURIComponent(run)}`;
  return takesRun ? `${path}?${new URLSearchParams({ run })}` : path;
}

export function Nav({ crowded = false, run = null }: Props) {
  const entries = [LAB, ...PAGES].map((page) => ({ path: page.path, label: page.label, href: addressOf(page, run) }));
  const { pathname } = window.location;
  // A sweep and a shared result belong to the lab, but are not its start.
  const current = pageAt(pathname) ?? { path: pathname.startsWith("/b/") ? null : "/", label: "Lab" };
  const currentOf = (path: string) => (path === current.path ? "page" : undefined);
  return (
    <nav aria-label="Pages" className={classes.nav} data-crowded={crowded || undefined}>
      <ul className={classes.links}>
        {entries.map(({ path, label, href }) => (
          <li key={path}>
            <a href={href} className={classes.link} aria-current={currentOf(path)}>
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
          {entries.map(({ path, label, href }) => (
            <Menu.Item key={path} component="a" href={href} aria-current={currentOf(path)} className={classes.item ?? ""}>
              {label}
            </Menu.Item>
          ))}
        </Menu.Dropdown>
      </Menu>
    </nav>
  );
}
