// A stand-in for OctoPrint, from its published interface (docs/api).
import { createHash } from 'node:crypto';
import { Standin, readForm, send, serveAlone } from './faults.mjs';

async function handle(request, response, host) {
  const url = new URL(request.url, 'http://host');
  const pathname = decodeURIComponent(url.pathname);
  const refuse = (status, error) => send(response, status, { error });
  if (host.options.key && request.headers['x-api-key'] !== host.options.key) {
    return refuse(403, "You don't have the permission to access the requested resource.");
  }
  const texts = { standby: 'Operational', printing: 'Printing', paused: 'Paused', cancelled: 'Operational', complete: 'Operational' };

  if (request.method === 'GET') {
    if (await host.refuse('status', request, response)) return undefined;
    if (pathname === '/api/version') return send(response, 200, { api: '0.1', server: '1.11.0', text: 'OctoPrint 1.11.0 (stand-in)' });
    if (pathname === '/api/files/local') return send(response, 200, { files: [], free: host.options.free ?? 1e9, total: 2e9 });
    if (pathname.startsWith('/api/files/local/')) {
      const name = pathname.slice('/api/files/local/'.length);
      const file = host.files.get(name);
      return file ? send(response, 200, { name, path: name, size: file.length, type: 'machinecode', origin: 'local', hash: createHash('sha1').update(file).digest('hex') }) : refuse(404, 'Not Found');
    }
    if (pathname === '/api/job') {
      const active = host.print.state === 'printing' || host.print.state === 'paused';
      return send(response, 200, {
        job: { file: { name: host.print.file || null, path: host.print.file || null, origin: 'local' } },
        progress: { completion: host.print.state === 'complete' ? 100 : active ? 25 : null, printTime: active ? 100 : null, printTimeLeft: active ? 300 : null },
        state: texts[host.print.state],
      });
    }
    if (pathname === '/api/printer') {
      return send(response, 200, { temperature: { tool0: { actual: 214.9, target: 215 }, bed: { actual: 60, target: 60 } }, state: { text: texts[host.print.state] } });
    }
    return refuse(404, 'Not Found');
  }
  if (pathname === '/api/files/local') {
    if (await host.refuse('upload', request, response)) return undefined;
    if (request.headers['content-length'] === undefined) return refuse(411, 'Length Required');
    const form = await readForm(request, await host.body(request, response));
    if (!form.file || !form.file.name) return refuse(400, 'No file to upload and no folder to create');
    if (!/\.(gcode|gco|g|sl1)$/.test(form.file.name)) return refuse(415, 'Unsupported file type');
    const name = form.fields.path ? `${form.fields.path}/${form.file.name}` : form.file.name;
    host.files.set(name, form.file.content);
    return send(response, 201, { done: true, effectiveSelect: false, effectivePrint: false, files: { local: { name, path: name, origin: 'local' } } });
  }
  if (await host.refuse('start', request, response)) return undefined;
  const command = JSON.parse((await host.body(request, response)).toString());
  const active = host.print.state === 'printing' || host.print.state === 'paused';
  if (pathname.startsWith('/api/files/local/')) {
    const name = pathname.slice('/api/files/local/'.length);
    if (!host.files.has(name)) return refuse(404, 'Not Found');
    if (command.command !== 'select') return refuse(400, 'unknown command');
    if (active) return refuse(409, 'Printer is already printing');
    if (command.print) host.begin(name);
    return send(response, 204, null);
  }
  if (pathname === '/api/job') {
    if (!active) return refuse(409, 'Printer is not printing');
    if (command.command === 'cancel') host.print.state = 'cancelled';
    else if (command.action === 'pause') host.print.state = 'paused';
    else if (command.action === 'resume') host.print.state = 'printing';
    else return refuse(400, 'unknown command');
    return send(response, 204, null);
  }
  return refuse(404, 'Not Found');
}

export const makeOctoPrint = (options) => new Standin(handle, options);
await serveAlone(makeOctoPrint, import.meta.url);
