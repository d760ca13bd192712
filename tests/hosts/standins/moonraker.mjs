// A stand-in for Moonraker, from its published interface (docs/external_api).
import { createHash } from 'node:crypto';
import { Standin, readForm, send, serveAlone } from './faults.mjs';

const largest = 1 << 30;

async function handle(request, response, host) {
  const url = new URL(request.url, 'http://host');
  const { pathname } = url;
  const refuse = (status, message) => send(response, status, { error: { code: status, message, traceback: '' } });
  if (host.options.key && request.headers['x-api-key'] !== host.options.key) return refuse(401, 'Unauthorized');
  const result = (value) => send(response, 200, { result: value });

  if (request.method === 'GET') {
    if (await host.refuse('status', request, response)) return undefined;
    if (pathname === '/server/info') {
      return result({ klippy_connected: true, klippy_state: 'ready', moonraker_version: 'v0.9.3-stand-in' });
    }
    if (pathname === '/printer/info') return result({ state: 'ready', hostname: 'stand-in', software_version: 'v0.12' });
    if (pathname === '/server/files/directory') {
      return result({ dirs: [], files: [], disk_usage: { total: 2e9, used: 1e9, free: host.options.free ?? 1e9 } });
    }
    if (pathname === '/server/files/metadata') {
      const name = url.searchParams.get('filename');
      const file = host.files.get(name);
      return file ? result({ filename: name, size: file.length, modified: 1 }) : refuse(404, `Metadata not available for <${name}>`);
    }
    if (pathname === '/printer/objects/query') {
      const progress = host.print.progress ?? 0.25;
      return result({
        eventtime: 1,
        status: {
          webhooks: { state: 'ready', state_message: 'Printer is ready' },
          print_stats: {
            filename: host.print.file, state: host.print.state, print_duration: 100 * progress, message: '',
            info: { total_layer: 40, current_layer: Math.round(40 * progress) },
          },
          virtual_sdcard: { progress, is_active: host.print.state === 'printing' },
          display_status: { message: null, progress },
          extruder: { temperature: 214.9, target: 215 },
          heater_bed: { temperature: 60.1, target: 60 },
        },
      });
    }
    return refuse(404, 'Not Found');
  }
  if (pathname === '/server/files/upload') {
    if (await host.refuse('upload', request, response)) return undefined;
    if (Number(request.headers['content-length'] ?? 0) > largest) return refuse(413, 'Content-Length too long');
    const form = await readForm(request, await host.body(request, response));
    if (!form.file) return refuse(400, 'No file name specifed in upload form');
    const hash = createHash('sha256').update(form.file.content).digest('hex');
    if (form.fields.checksum && form.fields.checksum.toLowerCase() !== hash) {
      return refuse(422, 'File checksum mismatch');
    }
    const name = form.fields.path ? `${form.fields.path}/${form.file.name}` : form.file.name;
    host.checked = form.fields.checksum === hash;
    host.files.set(name, form.file.content);
    return send(response, 201, {
      item: { path: name, root: 'gcodes', modified: 1, size: form.file.content.length, permissions: 'rw' },
      print_started: false, print_queued: false, action: 'create_file',
    });
  }
  if (await host.refuse('start', request, response)) return undefined;
  if (pathname === '/printer/print/start') {
    const name = url.searchParams.get('filename');
    if (!host.files.has(name)) return refuse(400, 'Unable to open file');
    if (host.print.state === 'printing' || host.print.state === 'paused') return refuse(400, 'SD busy');
    host.begin(name);
    return result('ok');
  }
  const states = { pause: 'paused', resume: 'printing', cancel: 'cancelled' };
  const state = states[pathname.replace('/printer/print/', '')];
  if (!state) return refuse(404, 'Not Found');
  host.print.state = state;
  return result('ok');
}

export const makeMoonraker = (options) => new Standin(handle, options);
await serveAlone(makeMoonraker, import.meta.url);
