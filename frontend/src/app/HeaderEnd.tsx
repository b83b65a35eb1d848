/** What every header ends with: dark or light, whatever the system says, and logging out where there is a login. */

import { useComputedColorScheme, useMantineColorScheme } from "@mantine/core";
import { useMutation, useQuery } from "@tanstack/react-query";
import { ask, query } from "../api/http";
import { IconLogout, IconMoon, IconSun } from "../ui/icons";
import { IconButton } from "../ui/IconButton";

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
      <IconButton label={`Use ${next} colours`} onClick={() => setColorScheme(next)}>
        {isDark ? <IconSun size={18} stroke={1.7} /> : <IconMoon size={18} stroke={1.7} />}
      </IconButton>
      {name !== null && (
        <IconButton
          label={logOut.error?.message ?? `Log out ${name}`}
          disabled={logOut.isPending}
          onClick={() => logOut.mutate()}
        >
          <IconLogout size={18} stroke={1.7} />
        </IconButton>
      )}
    </>
  );
}
