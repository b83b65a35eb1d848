/** Saves an item as a file that any Ridelab can open: a measured road goes with its heights, which another server does not have. */

import type { QueryClient } from "@tanstack/react-query";
import { askFile } from "../../api/http";
import { schemaQuery } from "../../server/queries";
import { download } from "../../lib/download";
import { fileOf, roadOf, type Exported } from "./files";

export async function saveItem(item: Exported, queries: QueryClient): Promise<void> {
  const { version } = await queries.query({ ...schemaQuery, staleTime: "static" });
  const id = roadOf(item);
  const road =
    id === null ? null : await (await askFile("get", "/roads/{id}", { path: { id }, query: { format: "csv" } })).text();
  const { name, type, text } = fileOf(item, version, road);
  const address = URL.createObjectURL(new Blob([text], { type }));
  download(address, name);
  URL.revokeObjectURL(address);
}
