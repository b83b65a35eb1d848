// Mantine's styles are named one by one in src/app/mantine.css and src/ui/mantine.css: the build fails where a component lacks its own.
import { readdirSync, readFileSync } from "node:fs";

const classes = (text) => new Set(text.match(/\bm_[0-9a-f]{6,8}\b/g));
const built = (ending) =>
  classes(
    readdirSync("dist/assets")
      .filter((name) => name.endsWith(ending))
      .map((name) => readFileSync(`dist/assets/${name}`, "utf8"))
      .join("\n"),
  );

const [used, styled] = [built(".js"), built(".css")];
const folder = "node_modules/@mantine/core/styles";
const missing = readdirSync(folder).filter(
  (name) =>
    name.endsWith(".layer.css") &&
    [...classes(readFileSync(`${folder}/${name}`, "utf8"))].some((each) => used.has(each) && !styled.has(each)),
);
if (missing.length > 0) throw new Error(`src/ui/mantine.css lacks ${missing.join(", ")}`);
