// What a screenshot shows, found in a page of its own: how many colours, and how much is not the ground.

/** A page of its own, the same for all pictures of a browser. */
const pages = new WeakMap();
const blank = (browser) => {
  if (!pages.has(browser)) pages.set(browser, browser.newPage());
  return pages.get(browser);
};

/** Colours of a PNG and the part of its pixels that differ from the most frequent one. */
export async function pixels(browser, png) {
  const page = await blank(browser);
  return page.evaluate(async (base64) => {
    const image = new Image();
    image.src = `data:image/png;base64,${base64}`;
    await image.decode();
    const canvas = document.createElement("canvas");
    [canvas.width, canvas.height] = [image.width, image.height];
    const pen = canvas.getContext("2d");
    pen.drawImage(image, 0, 0);
    const { data } = pen.getImageData(0, 0, image.width, image.height);
    const counts = new Map();
    for (let k = 0; k < data.length; k += 4) {
      const key = (data[k] << 16) | (data[k + 1] << 8) | data[k + 2];
      counts.set(key, (counts.get(key) ?? 0) + 1);
    }
    const most = Math.max(...counts.values());
    return { colours: counts.size, drawn: 1 - most / (data.length / 4) };
  }, png.toString("base64"));
}

/** The part of pixels that differ between two PNGs of the same size. */
export async function difference(browser, one, other) {
  const page = await blank(browser);
  return page.evaluate(async (both) => {
    const read = async (base64) => {
      const image = new Image();
      image.src = `data:image/png;base64,${base64}`;
      await image.decode();
      const canvas = document.createElement("canvas");
      [canvas.width, canvas.height] = [image.width, image.height];
      const pen = canvas.getContext("2d");
      pen.drawImage(image, 0, 0);
      return pen.getImageData(0, 0, image.width, image.height).data;
    };
    const [a, b] = [await read(both[0]), await read(both[1])];
    let differ = 0;
    for (let k = 0; k < a.length; k += 4) differ += Math.abs(a[k] - b[k]) + Math.abs(a[k + 1] - b[k + 1]) + Math.abs(a[k + 2] - b[k + 2]) > 24;
    return differ / (a.length / 4);
  }, [one.toString("base64"), other.toString("base64")]);
}
