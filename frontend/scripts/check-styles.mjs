// Mantine's styles are named one by one in src/app/mantine.css and src/ui/mantine.css: the build fails where a component lacks its own,
// and where a module's rule names no class of its own: it would hold on every page.
import { readdirSync, readFileSync } from "node:fs";
import postcss from "postcss";

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

const unscoped = readdirSync("src", { recursive: true, encoding: "utf8" })
  .filter((name) => name.endsWith(".module.css"))
  .flatMap((name) => {
    const selectors = [];
    postcss.parse(readFileSync(`src/${name}`, "utf8")).walkRules(({ parent, selectors: own }) => {
      if (parent.name !== "keyframes") selectors.push(...own);
    });
    return selectors.filter((selector) => !/\.[a-z]/i.test(selector)).map((selector) => `${name}: ${selector}`);
  });
if (unscoped.length > 0) throw new Error(`without a class of the module: ${unscoped.join("; ")}`);
