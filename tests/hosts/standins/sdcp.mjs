// A stand-in for a machine that speaks SDCP 3, from the vendor's published text.
import { createHash } from 'node:crypto';
import dgram from 'node:dgram';
import { WebSocketServer } from 'ws';
import { Standin, readForm, send, serveAlone } from './faults.mjs';

const board = '000000000001d354';

async function handle(request, response, host) {
  const { pathname } = new URL(request.url, 'http://host');
  if (pathname !== '/uploadFile/upload') return send(response, 404, 'Not Found');
  if (await host.refuse('upload', request, response)) return undefined;
  const form = await readForm(request, await host.body(request, response));
  const offset = Number(form.fields.Offset);
  const fail = (message) => send(response, 200, { code: '111111', messages: [{ field: 'common_field', message }], data: null, success: false });
  host.parts ??= new Map();
  const id = form.fields.Uuid;
  if (offset === 0) host.parts.set(id, []);
  const parts = host.parts.get(id);
  if (!parts) return fail(-2);
  if (parts.reduce((sum, part) => sum + part.length, 0) !== offset) return fail(-1);
  if (form.file.content.length > 1 << 20) return fail(-4);
  parts.push(form.file.content);
  const whole = Buffer.concat(parts);
  if (whole.length === Number(form.fields.TotalSize)) {
    const hash = createHash('md5').update(whole).digest('hex');
    // The list names what is there, whole or not; the MD5 tells.
    host.files.set(form.file.name, whole);
    host.damaged ??= new Set();
    if (form.fields.Check === '1' && hash !== form.fields['S-File-MD5']) {
      host.damaged.add(form.file.name);
      host.tell({ Id: '', Data: { Data: { ErrorCode: 1 }, MainboardID: board, TimeStamp: 1 }, Topic: `sdcp/error/${board}` });
    } else {
      host.damaged.delete(form.file.name);
    }
  }
  return send(response, 200, { code: '000000', messages: null, data: {}, success: true });
}

function obey(message, host) {
  const { Cmd, Data } = message.Data;
  const active = host.print.state === 'printing' || host.print.state === 'paused';
  if (Cmd === 258) {
    return { Ack: 0, FileList: [...host.files.keys()].map((name) => ({ name: `/local/${name}`, usedSize: 4096, totalSize: 1e9, storageType: 0, type: 1 })) };
  }
  if (Cmd === 128) {
    const name = Data.Filename.replace('/local/', '');
    if (active) return { Ack: 1 };
    if (!host.files.has(name)) return { Ack: 2 };
    if (host.damaged?.has(name)) return { Ack: 3 };
    host.begin(name);
    return { Ack: 0 };
  }
  const states = { 129: 'paused', 130: 'cancelled', 131: 'printing' };
  if (states[Cmd]) {
    if (!active) return { Ack: 1 };
    host.print.state = states[Cmd];
  }
  return { Ack: 0 };
}

function tellMore(Cmd, host) {
  if (Cmd === 0) {
    const subs = { standby: 0, printing: 3, paused: 6, cancelled: 8, complete: 9 };
    const active = host.print.state === 'printing' || host.print.state === 'paused';
    host.tell({
      Status: {
        CurrentStatus: [active ? 1 : 0], PreviousStatus: 0,
        PrintInfo: { Status: subs[host.print.state], CurrentLayer: 10, TotalLayer: 40, CurrentTicks: 100000, TotalTicks: 400000, Filename: host.print.file, ErrorNumber: 0, TaskId: 'x' },
      },
      MainboardID: board, TimeStamp: 1, Topic: `sdcp/status/${board}`,
    });
  }
  if (Cmd === 1) {
    host.tell({
      Attributes: {
        Name: 'stand-in', MachineName: 'Stand-in 8K', BrandName: 'CBD', ProtocolVersion: 'V3.0.0', FirmwareVersion: 'V1.0.0',
        MainboardID: board, Capabilities: ['FILE_TRANSFER', 'PRINT_CONTROL'], SupportFileType: host.options.types ?? ['CTB', 'GOO'], RemainingMemory: host.options.free ?? 1e9,
      },
      MainboardID: board, TimeStamp: 1, Topic: `sdcp/attributes/${board}`,
    });
  }
}

export function makeSdcp(options = {}) {
  const host = new Standin(handle, options);
  const clients = new Set();
  host.tell = (message) => { for (const client of clients) client.send(JSON.stringify(message)); };
  const { listen, stop } = host;
  host.listen = async (port) => {
    await listen.call(host, port);
    const sockets = new WebSocketServer({ server: host.server, path: '/websocket' });
    sockets.on('connection', (client) => {
      clients.add(client);
      client.on('close', () => clients.delete(client));
      client.on('error', () => {});
      client.on('message', async (text) => {
        if (`${text}` === 'ping') return client.send('pong');
        const message = JSON.parse(text);
        const { Cmd, RequestID } = message.Data;
        if (message.Data.MainboardID !== board) return undefined; // for another machine
        const fault = host.fault(Cmd === 128 ? 'start' : 'status');
        if (fault?.slow) await new Promise((resolve) => setTimeout(resolve, fault.slow));
        if (fault?.restart !== undefined) return host.restart(fault.restart);
        if (fault?.status || fault?.cut !== undefined) return client.terminate();
        const answer = obey(message, host);
        if (fault?.mute) return client.terminate();
        client.send(JSON.stringify({ Id: '', Data: { Cmd, Data: answer, RequestID, MainboardID: board, TimeStamp: 1 }, Topic: `sdcp/response/${board}` }));
        return tellMore(Cmd, host);
      });
    });
    if (!host.search) {
      host.search = dgram.createSocket({ type: 'udp4', reuseAddr: true });
      host.search.on('message', (text, from) => {
        if (`${text}` !== 'M99999') return;
        host.search.send(JSON.stringify({ Id: '', Data: { Name: 'stand-in', MachineName: 'Stand-in 8K', BrandName: 'CBD', MainboardIP: '127.0.0.1', MainboardID: board, ProtocolVersion: 'V3.0.0', FirmwareVersion: 'V1.0.0' } }), from.port, from.address);
      });
      await new Promise((resolve) => host.search.bind(3000, resolve));
    }
    return host;
  };
  host.stop = () => {
    for (const client of clients) client.terminate();
    clients.clear();
    if (host.over && host.search) {
      host.search.close();
      host.search = null;
    }
    return stop.call(host);
  };
  return host;
}

await serveAlone(makeSdcp, import.meta.url);
