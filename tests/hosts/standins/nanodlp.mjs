// A stand-in for NanoDLP, from its published interface (nanodlp/api-docs).
import { Standin, readForm, send, serveAlone } from './faults.mjs';

async function handle(request, response, host) {
  const { pathname } = new URL(request.url, 'http://host');
  host.plates ??= [];
  if (host.options.key && request.headers.authorization !== `Bearer ${host.options.key}`) {
    return send(response, 401, { message: 'Unauthorized' });
  }
  const done = () => send(response, 200, { success: true, message: 'Operation completed successfully' });
  const active = host.print.state === 'printing' || host.print.state === 'paused';
  if (pathname === '/plate/add') {
    if (await host.refuse('upload', request, response)) return undefined;
    if (request.headers['content-length'] === undefined) return send(response, 411, { message: 'Length Required' });
    const form = await readForm(request, await host.body(request, response));
    if (!form.file || form.file.field !== 'ZipFile' || !form.fields.ProfileID) return send(response, 400, { message: 'No file' });
    const id = host.plates.length + 1;
    // Sums of the archive tell a damaged one: none of its layers can be read.
    host.plates.push({ PlateID: id, Path: form.fields.Path, LayersCount: response.fault.damage ? 0 : 40 });
    host.files.set(form.file.name, form.file.content);
    return send(response, 302, null, { Location: `/plate/edit/${id}` });
  }
  const begins = pathname.match(/^\/api\/v1\/printer\/start\/(\d+)$/);
  if (begins && request.method === 'POST') {
    if (await host.refuse('start', request, response)) return undefined;
    const plate = host.plates[begins[1] - 1];
    if (!plate) return send(response, 404, { message: 'no such plate' });
    if (active) return send(response, 400, { message: 'Printer is printing' });
    host.begin(`${plate.Path}.nanodlp`);
    return done();
  }
  const states = { pause: 'paused', unpause: 'printing', stop: 'cancelled' };
  const state = states[pathname.replace('/api/v1/printer/printer/', '')];
  if (await host.refuse(state ? 'start' : 'status', request, response)) return undefined;
  if (state) {
    host.print.state = state;
    return done();
  }
  if (pathname === '/status') {
    return send(response, 200, {
      Printing: active, Paused: host.print.state === 'paused', Path: host.print.file.replace(/\.nanodlp$/, ''),
      LayerID: active ? '10' : 0, LayersCount: active ? 40 : 0, Hostname: 'stand-in', Build: '5231', disk: '42',
    });
  }
  if (pathname === '/plates/list/json') return send(response, 200, host.plates);
  return send(response, 404, { message: 'Not Found' });
}

export const makeNanoDlp = (options) => new Standin(handle, options);
await serveAlone(makeNanoDlp, import.meta.url);
