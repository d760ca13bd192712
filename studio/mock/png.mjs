// PNG files from bytes: grey (1 channel) or RGB (3 channels).
import { crc32, deflateSync } from "node:zlib";

function chunk(type, data) {
    const body = Buffer.concat([Buffer.from(type, "latin1"), data]);
    const out = Buffer.alloc(body.length + 8);
    out.writeUInt32BE(data.length, 0);
    body.copy(out, 4);
    out.writeUInt32BE(crc32(body), body.length + 4);
    return out;
}

export function png(width, height, channels, bytes) {
    const head = Buffer.alloc(13);
    head.writeUInt32BE(width, 0);
    head.writeUInt32BE(height, 4);
    head.set([8, channels === 3 ? 2 : 0, 0, 0, 0], 8);
    const rows = Buffer.alloc(height * (width * channels + 1));
    for (let y = 0; y < height; ++y) {
        rows.set(
            bytes.subarray(y * width * channels, (y + 1) * width * channels),
            y * (width * channels + 1) + 1,
        );
    }
    const magic = Buffer.from([0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a]);
    return Buffer.concat([
        magic,
        chunk("IHDR", head),
        chunk("IDAT", deflateSync(rows, { level: 1 })),
        chunk("IEND", Buffer.alloc(0)),
    ]);
}
