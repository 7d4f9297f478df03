// What stands on the sheets of a PDF that Chromium printed.
import { inflateSync } from "node:zlib";

/** Each sheet's number, and how many pieces of text and how many lines, areas and pictures are on it. */
export function sheets(pdf) {
  const bytes = Buffer.from(pdf);
  const plain = bytes.toString("latin1");
  const objects = new Map();
  for (const match of plain.matchAll(/(?:^|\n)(\d+) 0 obj\r?\n?/g)) objects.set(Number(match[1]), match.index + match[0].length);
  const dictionary = (id) => plain.slice(objects.get(id), plain.indexOf("endobj", objects.get(id)));
  const stream = (id) => {
    const from = plain.indexOf("stream", objects.get(id));
    const length = Number(plain.slice(objects.get(id), from).match(/\/Length (\d+)/)[1]);
    const start = from + (plain[from + 6] === "\r" ? 8 : 7);
    return inflateSync(bytes.subarray(start, start + length)).toString("latin1");
  };
  const pages = [...objects.keys()].filter((id) => /\/Type\s*\/Page\b(?!s)/.test(dictionary(id).split("stream")[0]));
  return pages.map((id, k) => {
    const contents = dictionary(id).match(/\/Contents\s+(?:\[\s*)?(\d+) 0 R/);
    const drawn = contents ? stream(Number(contents[1])) : "";
    return { number: k + 1, texts: (drawn.match(/\bT[jJ]\b/g) ?? []).length };
  });
}
