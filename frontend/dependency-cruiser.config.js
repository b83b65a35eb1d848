// The page's layers (docs/explanation/architecture.md), from top to bottom. A file imports from layers below its own; folders of one
// layer may import each other as long as no circle comes of it.
const LAYERS = ["app", "pages", "features", "plots|jobs", "lab|server", "ui|scenario", "lib|units|api"];

const within = (layers) => `^src/(${layers.join("|")})/`;

const upwards = LAYERS.slice(1).map((layer, above) => ({
  name: "no-import-upwards",
  comment: `src/(${layer})/ is below what it imports.`,
  severity: "error",
  from: { path: within([layer]) },
  to: { path: within(LAYERS.slice(0, above + 1)) },
}));

export const forbidden = [
  ...upwards,
  {
    name: "no-page-in-another",
    comment: "The lab alone shows another page: a sweep, where a link leads to one.",
    severity: "error",
    from: { path: "^src/pages/([^/]+)/" },
    to: { path: "^src/pages/", pathNot: ["^src/pages/$1/", "^src/pages/sweep/SweepPage[.]tsx$"] },
  },
  { name: "no-circle-of-files", severity: "error", from: {}, to: { circular: true } },
  { name: "no-circle-of-folders", severity: "error", scope: "folder", from: {}, to: { circular: true } },
  {
    name: "no-file-without-layer",
    severity: "error",
    from: { path: "^src/", pathNot: within(LAYERS) },
    to: {},
  },
];

export default {
  forbidden,
  options: {
    tsConfig: { fileName: "tsconfig.app.json" },
    tsPreCompilationDeps: true,
    doNotFollow: { path: "node_modules" },
    exclude: { path: ["^(node_modules|[.][.])", "[.]test[.]tsx?$"] }, // a test may compare with what uses it
  },
};
