// A stand-in for PrusaLink, from its published interface (Prusa-Link-Web, spec/openapi.yaml), with digest
// authentication (RFC 7616, MD5).
import { createHash, randomBytes } from 'node:crypto';
import { Standin, send, serveAlone } from './faults.mjs';

const md5 = (text) => createHash('md5').update(text).digest('hex');
const realm = 'Printer API';

/** Whether a request proves that its sender knows the password of maker. */
function isKnown(request, host) {
  const header = request.headers.authorization ?? '';
  if (!header.startsWith('Digest ')) return false;
  const field = (name) => (header.match(new RegExp(`${name}="?([^",]+)"?`)) ?? [])[1];
  if (!host.nonces?.has(field('nonce')) || field('username') !== 'maker') return false;
  const secret = md5(`maker:${realm}:${host.options.key}`);
  const question = md5(`${request.method}:${field('uri')}`);
  const proof = field('qop')
    ? md5(`${secret}:${field('nonce')}:${field('nc')}:${field('cnonce')}:${field('qop')}:${question}`)
    : md5(`${secret}:${field('nonce')}:${question}`);
  return proof === field('response') && field('uri') === request.url;
}

async function handle(request, response, host) {
  const pathname = decodeURIComponent(new URL(request.url, 'http://host').pathname);
  const refuse = (status, text, headers) => send(response, status, { title: 'error', text }, headers);
  if (host.options.key && !isKnown(request, host)) {
    // What comes with a question that is refused was sent for nothing.
    for await (const part of request) host.wasted = (host.wasted ?? 0) + part.length;
    host.nonces ??= new Set();
    const nonce = randomBytes(8).toString('hex');
    host.nonces.add(nonce);
    return refuse(401, 'Unauthorized', { 'WWW-Authenticate': `Digest realm="${realm}", nonce="${nonce}", qop="auth", stale="false"` });
  }
  const states = { standby: 'IDLE', printing: 'PRINTING', paused: 'PAUSED', cancelled: 'STOPPED', complete: 'FINISHED' };
  const active = host.print.state === 'printing' || host.print.state === 'paused';
  const place = '/api/v1/files/usb/';
  if (request.method === 'GET') {
    if (await host.refuse('status', request, response)) return undefined;
    if (pathname === '/api/version') return send(response, 200, { api: '2.0.0', server: '2.1.2', hostname: 'stand-in', text: 'PrusaLink' });
    if (pathname === '/api/v1/storage') {
      return send(response, 200, { storage_list: [{ name: 'usb', path: '/usb/', type: 'USB', read_only: false, available: true, free_space: host.options.free ?? 1e9, total_space: 2e9 }] });
    }
    if (pathname === '/api/v1/status') {
      const job = active ? { job: { id: 7, progress: 25, time_printing: 100, time_remaining: 300 } } : {};
      return send(response, 200, { ...job, printer: { state: states[host.print.state], temp_nozzle: 214.9, target_nozzle: 215, temp_bed: 60, target_bed: 60, status_printer: { ok: true, message: 'OK' } } });
    }
    if (pathname === '/api/v1/job') {
      if (!host.print.file) return send(response, 204, null);
      return send(response, 200, { id: 7, state: states[host.print.state], progress: 25, file: { name: 'SHORT~1.GCO', display_name: host.print.file, path: '/usb' } });
    }
    if (pathname.startsWith(place)) {
      const file = host.files.get(pathname.slice(place.length));
      return file ? send(response, 200, { name: 'SHORT~1.GCO', display_name: pathname.slice(place.length), size: file.length, type: 'PRINT_FILE' }) : refuse(404, 'File not found');
    }
    return refuse(404, 'Not Found');
  }
  if (request.method === 'PUT' && pathname.startsWith(place)) {
    if (await host.refuse('upload', request, response)) return undefined;
    if (request.headers['content-length'] === undefined) return refuse(411, 'Length Required');
    const name = pathname.slice(place.length);
    if (host.files.has(name) && request.headers.overwrite !== '?1') return refuse(409, 'File already exists');
    // The firmware writes while it receives: what has come of a broken upload is there, and cut.
    const fault = response.fault ?? {};
    const body = await host.body(request, response).catch((error) => {
      if (fault.cut !== undefined) host.files.set(name, Buffer.alloc(fault.cut));
      throw error;
    });
    host.files.set(name, fault.damage ? body.subarray(0, body.length - 1) : body);
    return send(response, 201, { name, size: body.length });
  }
  if (await host.refuse('start', request, response)) return undefined;
  if (request.method === 'POST' && pathname.startsWith(place)) {
    const name = pathname.slice(place.length);
    if (!host.files.has(name)) return refuse(404, 'File not found');
    if (active) return refuse(409, 'Printer is currently printing');
    host.begin(name);
    return send(response, 204, null);
  }
  if (pathname.startsWith('/api/v1/job/7')) {
    if (!active) return refuse(409, 'Job is not in a state for this');
    const what = pathname.slice('/api/v1/job/7'.length);
    if (request.method === 'DELETE' && what === '') host.print.state = 'cancelled';
    else if (request.method === 'PUT' && what === '/pause') host.print.state = 'paused';
    else if (request.method === 'PUT' && what === '/resume') host.print.state = 'printing';
    else return refuse(404, 'Not Found');
    return send(response, 204, null);
  }
  return refuse(404, 'Not Found');
}

export const makePrusaLink = (options) => new Standin(handle, options);
await serveAlone(makePrusaLink, import.meta.url);
