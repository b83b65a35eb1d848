/** The parts of plotly.js that the bundle is made of; what it can do is typed in plotly.ts. */
declare module "plotly.js/lib/*" {
  const part: { readonly register: (traces: readonly unknown[]) => void };
  export default part;
}
