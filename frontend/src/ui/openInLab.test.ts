import { expect, it } from "vitest";
import { navigateIfStillHere } from "./openInLab";

function browser() {
  const at = (href: string) => ({ href, pathname: href.split("?")[0] ?? "" });
  const opened: unknown[] = [];
  return {
    opened,
    latestLocation: at("/b/7?sort=speed"),
    navigate: (address: unknown) => opened.push(address),
    leave: at,
  };
}

it("An answer opens its page where the reader has stayed, also with another search part", () => {
  const pages = browser();
  const { href, go } = navigateIfStillHere(pages);
  pages.latestLocation = pages.leave("/b/7?sort=force");
  go({ to: "/" });
  expect(pages.opened).toEqual([{ to: "/" }]);
  expect(href).toBe("/b/7?sort=speed");
});

it("An answer does not take the reader off another page", () => {
  const pages = browser();
  const { go } = navigateIfStillHere(pages);
  pages.latestLocation = pages.leave("/paper");
  go({ to: "/" });
  expect(pages.opened).toEqual([]);
});
