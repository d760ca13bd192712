// A stand-in for RepRapFirmware 3, from its published HTTP requests: alone (rr_...), or with a single-board
// computer (machine/...).
import { crc32 } from 'node:zlib';
import { Standin, send, serveAlone } from './faults.mjs';

const folder = '0:/gcodes/';

function run(code, host) {
  const active = host.print.state === 'printing' || host.print.state === 'paused';
  if (code.startsWith('M32 ')) {
    const name = code.slice(5, -1).replace(folder, '');
    if (!host.files.has(name)) return `Error: M32: Failed to open file ${name}\n`;
    if (active) return 'Error: M32: Cannot start printing, because a file is already being printed\n';
    host.begin(name);
  } else if (code === 'M25') {
    if (host.print.state === 'printing') host.print.state = 'paused';
  } else if (code === 'M24') {
    if (host.print.state === 'paused') host.print.state = 'printing';
  } else if (code === 'M0') {
    if (host.print.state === 'paused') host.print.state = 'cancelled';
  } else {
    return `Error: unsupported command: ${code}\n`;
  }
  return '';
}

function model(host) {
  const active = host.print.state === 'printing' || host.print.state === 'paused';
  const words = { printing: 'processing', paused: 'paused' };
  return {
    boards: [{ firmwareName: 'RepRapFirmware for Duet 3 Mini 5+', firmwareVersion: '3.5.4', name: 'Duet 3 Mini 5+' }],
    volumes: [{ freeSpace: host.options.free ?? 1e9 }],
    state: { status: words[host.print.state] ?? 'idle', displayMessage: '' },
    heat: { heaters: [{ current: 60, active: 60 }, { current: 214.9, active: 215 }] },
    job: active
      ? { file: { fileName: folder + host.print.file, size: 400, numLayers: 40 }, filePosition: 100, duration: 100, layer: 10, timesLeft: { file: 300 } }
      : { file: {}, lastFileName: host.print.file ? folder + host.print.file : null, lastFileCancelled: host.print.state === 'cancelled', lastFileAborted: false },
  };
}

async function handle(request, response, host) {
  const url = new URL(request.url, 'http://host');
  const pathname = decodeURIComponent(url.pathname);
  const { searchParams } = url;
  const computer = host.options.computer;
  host.session ??= { key: 4711, reply: '' };
  if (pathname.startsWith('/rr_') ? computer : !computer) return send(response, 404, 'Not Found');

  if (pathname === '/rr_connect' || pathname === '/machine/connect') {
    if (await host.refuse('status', request, response)) return undefined;
    const right = searchParams.get('password') === (host.options.key ?? 'reprap');
    if (computer) return right ? send(response, 200, { sessionKey: `${host.session.key}` }) : send(response, 403, 'Forbidden');
    return send(response, 200, right ? { err: 0, sessionTimeout: 8000, boardType: 'duet3mini', apiLevel: 1, sessionKey: host.session.key } : { err: 1 });
  }
  if (request.headers['x-session-key'] !== `${host.session.key}`) return send(response, 401, 'Unauthorized');
  const upload = pathname === '/rr_upload' || (request.method === 'PUT' && pathname.startsWith('/machine/file/'));
  if (upload) {
    if (await host.refuse('upload', request, response)) return undefined;
    if (request.headers['content-length'] === undefined) return send(response, 411, 'Length Required');
    const name = (searchParams.get('name') ?? pathname.slice('/machine/file/'.length)).replace(folder, '');
    const body = await host.body(request, response);
    const sum = searchParams.get('crc32');
    if (sum !== null && parseInt(sum, 16) !== crc32(body)) return send(response, 200, { err: 1 });
    // Without a checksum a damaged file is noticed by its size alone.
    host.files.set(name, computer && response.fault.damage ? body.subarray(1) : body);
    return computer ? send(response, 201, null) : send(response, 200, { err: 0 });
  }
  const isCode = pathname === '/rr_gcode' || pathname === '/machine/code';
  if (await host.refuse(isCode ? 'start' : 'status', request, response)) return undefined;
  if (pathname === '/rr_gcode') {
    host.session.reply = run(searchParams.get('gcode'), host);
    return send(response, 200, { buff: 255 });
  }
  if (pathname === '/rr_reply') return send(response, 200, host.session.reply);
  if (pathname === '/machine/code') return send(response, 200, run((await host.body(request, response)).toString(), host));
  if (pathname === '/rr_fileinfo' || pathname.startsWith('/machine/fileinfo/')) {
    const file = host.files.get((searchParams.get('name') ?? pathname.slice('/machine/fileinfo/'.length)).replace(folder, ''));
    if (computer) return file ? send(response, 200, { size: file.length }) : send(response, 404, 'Not Found');
    return send(response, 200, file ? { err: 0, size: file.length } : { err: 1 });
  }
  if (pathname === '/rr_model') {
    const key = searchParams.get('key');
    return send(response, 200, { key, flags: searchParams.get('flags'), result: model(host)[key] });
  }
  if (pathname === '/machine/status') return send(response, 200, model(host));
  return send(response, 404, 'Not Found');
}

export const makeDuet = (options = {}) => new Standin(handle, options);
await serveAlone(makeDuet, import.meta.url);
