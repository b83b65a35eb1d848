/** A button of a header that is only its icon where there is little room. */

import ui from "./ui.module.css";

export const compact = { root: ui.compact ?? "", label: ui.compactLabel ?? "", section: ui.compactSection ?? "" };
