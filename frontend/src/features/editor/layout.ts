/** Which parts of the schema stand first, and how the rest falls into sections. */

import type { Pointer } from "../../scenario/path";
import { findMember, humanise, type Group, type Member } from "../../scenario/schema";

/** What most people come to change. */
const ESSENTIALS: readonly Pointer[] = ["/road/bump", "/speed", "/mpc/stage_weights"];

export interface Section {
  readonly key: Pointer;
  readonly title: string;
  readonly description: string;
  readonly essential: boolean;
  readonly members: readonly Member[];
}

function section(group: Group, essential: boolean): Section {
  const { pointer, title, description, members } = group;
  return { key: pointer, title, description, essential, members };
}

function without(group: Group, pointers: readonly Pointer[]): Group {
  const members = group.members
    .filter((member) => !pointers.includes(member.pointer))
    .map((member) => (member.kind === "group" ? without(member, pointers) : member))
    .filter((member) => member.kind !== "group" || member.members.length > 0);
  return { ...group, members };
}

/** Essentials first, then every top-level part with what is left of it; nothing of the schema is lost. */
export function sections(form: Group): readonly Section[] {
  const first = ESSENTIALS.map((pointer) => findMember(form, pointer)).filter((member) => member?.kind === "group");
  const rest = without(form, ESSENTIALS).members;
  const loose = rest.filter((member) => member.kind !== "group");
  const groups = rest.filter((member) => member.kind === "group");
  return [
    ...first.map((group) => section(group, true)),
    ...groups.map((group) => section(group, false)),
    ...(loose.length > 0
      ? [{ key: "/" as const, title: humanise("other"), description: "", essential: false, members: loose }]
      : []),
  ];
}

/** What is left of a section where every word has to stand in a field's name or in the names of the parts it lies in. */
export function matching(section: Section, text: string): Section | null {
  const words = text.toLowerCase().split(/\s+/).filter(Boolean);
  const members = withWords(section.members, section.title, words);
  return members.length === 0 ? null : { ...section, members };
}

function withWords(members: readonly Member[], parts: string, words: readonly string[]): readonly Member[] {
  return members.flatMap((member): readonly Member[] => {
    const inside = `${parts} ${member.title}`;
    if (member.kind === "group") {
      const below = withWords(member.members, inside, words);
      return below.length === 0 ? [] : [{ ...member, members: below }];
    }
    const entries = member.kind === "vector" ? member.items.map(({ title }) => title).join(" ") : "";
    const names = `${inside} ${entries} ${member.pointer.slice(1).replace(/\//g, ".")}`.toLowerCase();
    return words.every((word) => names.includes(word)) ? [member] : [];
  });
}
