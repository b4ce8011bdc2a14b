// Numbers, texts, lists and arrays of numbers as one file: JSON that says where each array is, and the arrays behind it.
// Of whole numbers the differences are stored: lists of corners become small when the file is compressed.

const arrayTypes = { Float32Array, Uint32Array, Uint8Array } as const;
type ArrayName = keyof typeof arrayTypes;

interface Place {
  array: ArrayName;
  /** Bytes behind the JSON. */
  at: number;
  length: number;
}

const padded = (size: number): number => 4 * Math.ceil(size / 4);
const isPlace = (value: unknown): value is Place => typeof value === 'object' && value !== null && 'array' in value;

function differences(array: ArrayBufferView): ArrayBufferView {
  return array instanceof Uint32Array ? array.map((number, i) => number - (array[i - 1] ?? 0)) : array;
}

function sums(array: InstanceType<(typeof arrayTypes)[ArrayName]>): ArrayBufferView {
  if (array instanceof Uint32Array) array.forEach((difference, i) => (array[i] = (array[i - 1] ?? 0) + difference));
  return array;
}

export function pack(value: unknown): Uint8Array<ArrayBuffer> {
  const arrays: { at: number; bytes: Uint8Array }[] = [];
  let size = 0;
  const json = JSON.stringify(value, (_, each: unknown) => {
    if (!ArrayBuffer.isView(each)) return each;
    const name = each.constructor.name as ArrayName;
    if (!(name in arrayTypes)) throw new Error(`pack: no file holds a ${name}`);
    const place: Place = { array: name, at: size, length: each.byteLength / arrayTypes[name].BYTES_PER_ELEMENT };
    const stored = differences(each);
    arrays.push({ at: size, bytes: new Uint8Array(stored.buffer, stored.byteOffset, stored.byteLength) });
    size += padded(each.byteLength);
    return place;
  });
  const text = new TextEncoder().encode(json);
  const begin = 4 + padded(text.length);
  const all = new Uint8Array(begin + size);
  new DataView(all.buffer).setUint32(0, text.length, true);
  all.set(text, 4);
  for (const { at, bytes } of arrays) all.set(bytes, begin + at);
  return all;
}

/** What was packed; arrays lie in the file itself. */
export function unpack(file: ArrayBuffer): unknown {
  const length = new DataView(file).getUint32(0, true);
  const begin = 4 + padded(length);
  const text = new TextDecoder().decode(new Uint8Array(file, 4, length));
  return JSON.parse(text, (_, each: unknown) =>
    isPlace(each) ? sums(new arrayTypes[each.array](file, begin + each.at, each.length)) : each);
}
