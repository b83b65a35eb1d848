/** What a sweep is called that has no name. */
export const titleOf = (fields: readonly { readonly title: string }[]) => fields.map(({ title }) => title).join(" × ") || "The scenario alone";
