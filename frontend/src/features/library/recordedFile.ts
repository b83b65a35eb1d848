import { createAtom } from "@tanstack/react-store";
import type { RecordingPreview } from "../../api/types";

/** A file that is about to be sent. */
export interface RecordedFile {
  readonly name: string;
  readonly csv: string;
  readonly preview: RecordingPreview;
}

export const recordedFile = createAtom<RecordedFile | null>(null);
