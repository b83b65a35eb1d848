/** Keys as they are written on this machine's keyboard. */
export const keyNames = (keys: string): string => {
  const mod = /Mac|iPhone|iPad/.test(navigator.userAgent) ? "⌘" : "Ctrl";
  return keys.replace("mod", mod).replace("shift", "Shift").replace(/\+/g, " + ");
};
