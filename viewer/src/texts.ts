// The messages of the frames of a chunk. The file has their beginnings, each once.

import { Table } from "./format";

const LEFT_OUT = 0xffffffff;

export interface Message {
  text: string;
  /** The text in lower case, to be searched. */
  lower: string;
  /** Of the whole message. */
  bytes: number;
  isWhole: boolean;
}

export class Texts {
  private readonly ends: Uint32Array;
  private readonly known: (Message | undefined)[] = [];
  private readonly decoder = new TextDecoder();

  constructor(
    private readonly sizes: Table,
    private readonly bytes: Table,
  ) {
    let end = 0;
    this.ends = Uint32Array.from(sizes.recorded, (size) => (end += size));
  }

  /** Return a message by its number in the table of frames: null if the frame has none, or a text that is left out. */
  of(number: number): Message | null {
    if (number === 0 || number === LEFT_OUT) return null;
    const row = number - 1;
    return (this.known[row] ??= this.read(row));
  }

  isLeftOut(number: number): boolean {
    return number === LEFT_OUT;
  }

  private read(row: number): Message {
    const { recorded, bytes } = this.sizes;
    const end = this.ends[row];
    const octets = (this.bytes.byte as Uint8Array).subarray(end - recorded[row], end);
    const text = this.decoder.decode(octets);
    return { text, lower: text.toLowerCase(), bytes: bytes[row], isWhole: recorded[row] === bytes[row] };
  }
}
