import { Text } from "@mantine/core";
import { IconLock } from "../icons";
import type { Link } from "../api/types";
import share from "../share/share.module.css";
import { formatDay } from "../units/dates";

/** Says that this is a shared sweep, when it was shared and what computed it. */
export function SharedBatchBanner({ link }: { readonly link: Link }) {
  const same = link.core_version === link.current_core_version;
  return (
    <section className={share.banner} aria-label="Shared result">
      <IconLock size={17} stroke={1.7} aria-hidden />
      <Text size="sm" className={share.bannerText ?? ""}>
        Shared sweep, computed on {formatDay(link.computed_at)} by core {link.core_version}. Read-only.
        {!same && ` This server now runs core ${link.current_core_version}.`}
      </Text>
    </section>
  );
}
