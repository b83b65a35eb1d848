/** A line of the server's Markdown: `code`, **bold** and *emphasis*; anything else stands as it is. */

import { Fragment } from "react";
import { typeset } from "./numbers";

const PART = /(`[^`]+`|\*\*[^*]+\*\*|\*[^*]+\*)/;

export function Inline({ text }: { readonly text: string }) {
  return (
    <>
      {text.split(PART).map((part, index) => (
        <Fragment key={index}>{styled(part)}</Fragment>
      ))}
    </>
  );
}

function styled(part: string) {
  if (part.length > 2 && part.startsWith("`") && part.endsWith("`")) return <code>{part.slice(1, -1)}</code>;
  if (part.length > 4 && part.startsWith("**") && part.endsWith("**")) return <b>{part.slice(2, -2)}</b>;
  if (part.length > 2 && part.startsWith("*") && part.endsWith("*")) return <em>{part.slice(1, -1)}</em>;
  return typeset(part);
}
