// What every stand-in shares: the files that it has, the starts that it was told, and faults on order.
//
// A fault is an object: {on: "upload" | "start" | "status" | "any", times: 1} with one of
//   {status: 503}       answers with this status, before the body is read
//   {cut: 1000}         breaks the connection after so many bytes of the body
//   {mute: true}        does what it is asked, and breaks the connection instead of answering
//   {slow: 200}         waits so many milliseconds before it answers
//   {damage: true}      changes a byte of what it has received
//   {restart: 300}      breaks all connections and refuses new ones for so many milliseconds
import http from 'node:http';
import https from 'node:https';
import fs from 'node:fs';

export class Standin {
  /** handle(request, response, standin) answers a request; options: {key, tls: {key, cert}}. */
  constructor(handle, options = {}) {
    this.handle = handle;
    this.options = options;
    this.files = new Map(); // name to Buffer
    this.starts = []; // {name, size} of every print that was begun
    this.print = { state: 'standby', file: '' };
    this.faults = [];
    this.requests = []; // "METHOD path", with what a test wants to know
    this.sockets = new Set();
    this.began = null; // when the first byte of an upload came
  }

  async listen(port = 0) {
    const answer = (request, response) => this.answer(request, response);
    this.server = this.options.tls ? https.createServer(this.options.tls, answer) : http.createServer(answer);
    this.server.on('checkContinue', answer);
    this.server.on('connection', (socket) => {
      this.sockets.add(socket);
      socket.on('close', () => this.sockets.delete(socket));
      socket.on('error', () => {});
    });
    this.server.keepAliveTimeout = 2000;
    await new Promise((resolve) => this.server.listen(port, '127.0.0.1', resolve));
    this.port = this.server.address().port;
    this.url = `${this.options.tls ? 'https' : 'http'}://127.0.0.1:${this.port}`;
    return this;
  }

  async close() {
    this.over = true;
    await this.stop();
  }

  /** Breaks all connections and takes no more. */
  async stop() {
    for (const socket of this.sockets) socket.destroy();
    if (this.server.listening) await new Promise((resolve) => this.server.close(resolve));
  }

  order(fault) {
    this.faults.push({ on: 'upload', times: 1, ...fault });
  }

  /** Takes the next fault that a request of this kind meets. */
  fault(kind) {
    const index = this.faults.findIndex((fault) => fault.on === kind || fault.on === 'any');
    if (index < 0) return null;
    const fault = this.faults[index];
    if (--fault.times <= 0) this.faults.splice(index, 1);
    return fault;
  }

  async restart(milliseconds) {
    const { port } = this;
    await this.stop();
    setTimeout(() => { if (!this.over) this.listen(port).catch(() => {}); }, milliseconds);
  }

  async answer(request, response) {
    this.requests.push(`${request.method} ${request.url}`);
    request.on('error', () => {});
    response.on('error', () => {});
    try {
      await this.handle(request, response, this);
    } catch (error) {
      if (error.message !== 'cut') console.error(error);
      request.socket?.destroy();
    }
  }

  /** Meets a fault before a body is read. Returns true when it has answered. */
  async refuse(kind, request, response) {
    const fault = this.fault(kind);
    response.fault = fault ?? {};
    if (!fault) return false;
    if (fault.slow) await new Promise((resolve) => setTimeout(resolve, fault.slow));
    if (fault.restart !== undefined) {
      await this.restart(fault.restart);
      return true;
    }
    if (fault.status) {
      response.setHeader('Connection', 'close');
      send(response, fault.status, { error: { code: fault.status, message: `fault ${fault.status}` } });
      return true;
    }
    return false;
  }

  /** Reads a body whole, and meets the fault of its response. */
  async body(request, response) {
    const fault = response.fault ?? {};
    if (request.headers.expect === '100-continue') response.writeContinue();
    const parts = [];
    let size = 0;
    for await (const part of request) {
      this.began ??= performance.now();
      size += part.length;
      if (fault.cut !== undefined && size >= fault.cut) {
        request.socket.destroy();
        throw new Error('cut');
      }
      parts.push(part);
    }
    if (fault.cut !== undefined) {
      request.socket.destroy();
      throw new Error('cut');
    }
    const whole = Buffer.concat(parts);
    if (fault.damage && whole.length > 0) whole[whole.length >> 1] ^= 1;
    return whole;
  }

  begin(name) {
    this.starts.push({ name, size: this.files.get(name)?.length ?? -1 });
    this.print = { state: 'printing', file: name };
  }
}

/** Answers, unless the response's fault keeps the answer back. */
export function send(response, status, json, headers = {}) {
  if (response.fault?.mute) {
    response.socket?.destroy();
    return;
  }
  const text = json === null ? '' : typeof json === 'string' ? json : JSON.stringify(json);
  response.writeHead(status, { 'Content-Type': 'application/json', 'Content-Length': Buffer.byteLength(text), ...headers });
  response.end(text);
}

/** Reads a form of fields and one file (RFC 7578) by a foreign parser. */
export async function readForm(request, body) {
  const { default: busboy } = await import('busboy');
  return new Promise((resolve, reject) => {
    const form = { fields: {}, file: null };
    const parser = busboy({ headers: request.headers });
    parser.on('file', (field, stream, info) => {
      const parts = [];
      stream.on('data', (part) => parts.push(part));
      stream.on('close', () => {
        form.file = { field, name: info.filename, content: Buffer.concat(parts), whole: !stream.truncated };
      });
    });
    parser.on('field', (name, value) => { form.fields[name] = value; });
    parser.on('close', () => resolve(form));
    parser.on('error', reject);
    parser.end(body);
  });
}

/** Runs a stand-in as a program: node HOST.mjs [PORT] [KEY]. */
export async function serveAlone(make, url) {
  if (process.argv[1] !== fs.realpathSync(new URL(url).pathname)) return;
  const standin = await make({ key: process.argv[3] }).listen(Number(process.argv[2] ?? 0));
  console.log(standin.url);
}
