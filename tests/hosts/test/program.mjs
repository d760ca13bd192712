// The program under test, with a configuration of its own, and every stand-in with what its host needs.
import { spawn } from 'node:child_process';
import { randomBytes } from 'node:crypto';
import fs from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import { makeDuet } from '../standins/duet.mjs';
import { makeMoonraker } from '../standins/moonraker.mjs';
import { makeNanoDlp } from '../standins/nanodlp.mjs';
import { makeOctoPrint } from '../standins/octoprint.mjs';
import { makePrusaLink } from '../standins/prusalink.mjs';
import { makeSdcp } from '../standins/sdcp.mjs';

export const command = process.env.LAMELLA ?? 'build/release/lamella';

/** Every host: how it is made, and a file that it takes. */
export const hosts = [
  { kind: 'moonraker', make: makeMoonraker, ending: '.gcode', key: true },
  { kind: 'octoprint', make: makeOctoPrint, ending: '.gcode', key: true },
  { kind: 'prusalink', make: makePrusaLink, ending: '.gcode', key: true },
  { kind: 'sdcp', make: makeSdcp, ending: '.goo', key: false },
  { kind: 'duet', make: makeDuet, ending: '.gcode', key: true },
  { kind: 'duet', label: 'duet with a computer', make: (options) => makeDuet({ ...options, computer: true }), ending: '.gcode', key: true },
  { kind: 'nanodlp', make: makeNanoDlp, ending: '.nanodlp', key: true },
];

export const temporary = fs.mkdtempSync(path.join(os.tmpdir(), 'lamella-hosts-'));
process.on('exit', () => fs.rmSync(temporary, { recursive: true, force: true }));

/** Numbers that look random, the same in every run. */
export function makeRandom(seed) {
  let state = seed >>> 0;
  return () => {
    state = (state + 0x6d2b79f5) >>> 0;
    let t = Math.imul(state ^ (state >>> 15), 1 | state);
    t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
    return ((t ^ (t >>> 14)) >>> 0) / 4294967296;
  };
}

/** A folder with a hosts.toml; `text` is its content. */
export function makeConfig(text, mode = 0o600) {
  const folder = fs.mkdtempSync(path.join(temporary, 'config-'));
  fs.mkdirSync(path.join(folder, 'lamella'));
  const file = path.join(folder, 'lamella', 'hosts.toml');
  fs.writeFileSync(file, text, { mode });
  fs.chmodSync(file, mode);
  return folder;
}

export const newKey = () => `secret-${randomBytes(12).toString('hex')}`;

/** Starts a stand-in, known to the program as `printer`, that goes with the test. */
export async function start(t, host, options = {}) {
  const key = host.key ? newKey() : undefined;
  const standin = await host.make({ key, ...options }).listen();
  t.after(() => standin.close());
  const config = makeConfig(`[printer]\nkind = "${host.kind}"\nurl = "${standin.url}"\n${key ? `key = "${key}"\n` : ''}${options.config ?? ''}`);
  return { standin, key, config };
}

/** A file of so many bytes that look random. */
export function makeFile(name, size, random = makeRandom(size)) {
  const file = path.join(temporary, name);
  const bytes = Buffer.alloc(size);
  for (let i = 0; i < size; i += 1) bytes[i] = Math.floor(random() * 256);
  fs.writeFileSync(file, bytes);
  return { file, bytes };
}

/** Runs the program to its end. */
export function run(args, config, { environment = {}, whileRunning } = {}) {
  return new Promise((resolve, reject) => {
    const began = performance.now();
    const child = spawn(command, args, { env: { ...process.env, XDG_CONFIG_HOME: config, ...environment } });
    let out = '';
    let error = '';
    child.stdout.on('data', (part) => { out += part; });
    child.stderr.on('data', (part) => { error += part; });
    child.on('error', reject);
    child.on('close', (code) => resolve({ code, out, error, seconds: (performance.now() - began) / 1000 }));
    whileRunning?.(child);
  });
}

export const quick = ['--retry-wait', '0.02', '--confirm', '0.4'];
