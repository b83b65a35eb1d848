/** Whether a part of the page has come near the window, or is being printed; once so, always so. */

import { useIntersection } from "@mantine/hooks";
import { useState } from "react";
import { printing } from "../../lib/printing";
import { useStore } from "../../lib/store";

/** What is this near to the window is as good as in it. */
const NEAR = "300px 0px";

export function useVisible() {
  const { ref, entry } = useIntersection<HTMLElement>({ rootMargin: NEAR });
  const printed = useStore(printing);
  const [visible, setVisible] = useState(false);
  if (!visible && (printed || entry?.isIntersecting === true)) setVisible(true);
  return { ref, visible, printed };
}
