// Beside each file a browser keeps for ever stands its brotli form, made once and as small as it gets; the service sends it.
import { readdir, readFile, writeFile } from "node:fs/promises";
import { promisify } from "node:util";
import { brotliCompress } from "node:zlib";

const compress = promisify(brotliCompress); // at its best level unless told otherwise
const folder = new URL("../dist/assets/", import.meta.url);
const names = (await readdir(folder)).filter((name) => /\.(css|js|svg)$/.test(name));

await Promise.all(
  names.map(async (name) => {
    const file = new URL(name, folder);
    await writeFile(new URL(`${name}.br`, folder), await compress(await readFile(file)));
  }),
);
