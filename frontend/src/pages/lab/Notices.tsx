/** What stands between the toolbar and the results when something needs saying. */

import { Button, Loader, Text } from "@mantine/core";
import { useEffect, useState } from "react";
import type { Strategy } from "../../api/types";
import { useLabContext, useLab } from "../../lab/context";
import { lawsText } from "../../lab/laws";
import type { Result } from "../../lab/result";
import ui from "../../ui/ui.module.css";

const SLOW_AFTER_MS = 1200;

export function Notices({ strategies }: { readonly strategies: readonly Strategy[] }) {
  const busy = useLab((state) => state.busy);
  const failure = useLab((state) => state.failure);
  const refused = useLab(
    (state) => Object.keys(state.serverErrors.fields).length + state.serverErrors.general.length > 0,
  );
  const shown = useLab((state) => state.shown);
  // There is no table to say why.
  const none = useLab(({ strategies: on }) => shown !== null && !on.some((id) => id in shown.summaries));
  const { lab } = useLabContext();
  const isShared = useLab((state) => state.shared !== null);
  const laws = lawsText(strategies, busy || !shown ? {} : shown.summaries);
  return (
    <>
      {busy && <SlowNotice shown={shown} />}
      {refused && shown && (
        <div className={ui.notice} role="status">
          <Text>The plots show the last scenario that could be run; the value to change is marked in the form.</Text>
          <Button size="compact-xs" onClick={lab.undo}>
            Undo
          </Button>
        </div>
      )}
      {failure?.kind === "failed" && (
        <div className={ui.notice} role="alert">
          <Text>This scenario could not be run: {failure.message}</Text>
        </div>
      )}
      {laws.changed.length > 0 && (
        <div className={ui.notice} role="status">
          <Text>
            {laws.changed.join(", ")}: the file was saved since. These are the numbers of the law that stood there.
          </Text>
          {!isShared && (
            <Button size="compact-xs" onClick={lab.runAgain}>
              Run again
            </Button>
          )}
        </div>
      )}
      {laws.gone.length > 0 && (
        <div className={ui.notice} role="status">
          <Text>{laws.gone.join(", ")}: there is no such controller here any more. These are the stored numbers.</Text>
        </div>
      )}
      {none &&
        shown?.failed.map(({ strategy, message }) => (
          <div key={strategy} className={ui.notice} role="alert">
            <Text>
              {strategies.find(({ id }) => id === strategy)?.label ?? strategy} could not be computed: {message}
            </Text>
          </div>
        ))}
    </>
  );
}

/** Mounted with a request; speaks up only where nothing new is shown for long. */
function SlowNotice({ shown }: { readonly shown: Result | null }) {
  const [slow, setSlow] = useState<Result | null>();
  useEffect(() => {
    const timer = setTimeout(() => setSlow(shown), SLOW_AFTER_MS);
    return () => clearTimeout(timer);
  }, [shown]);
  if (slow !== shown) return null;
  return (
    <div className={ui.notice} role="status">
      <Loader size={14} />
      <Text>Computing. The previous curves are dimmed until the new ones arrive.</Text>
    </div>
  );
}
