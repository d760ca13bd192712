// Jobs that are computed while they are sent, certificates, and the file of hosts.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import fs from 'node:fs';
import http from 'node:http';
import path from 'node:path';
import { test } from 'node:test';
import { hosts, makeConfig, makeFile, newKey, quick, run, start, temporary } from './program.mjs';

const moonraker = hosts.find((host) => host.kind === 'moonraker');
const octoprint = hosts.find((host) => host.kind === 'octoprint');
const repeats = Number(process.env.LAMELLA_HOST_STREAMS ?? 3);
const part = ['--shape', 'sphere', '--shape-radius', '4', '--cell', '2', '--beam', '0.6', '--printer', 'marlin'];

/** The file that `lamella slice` writes. */
async function sliced(name) {
  const file = path.join(temporary, name);
  const { code, error } = await run(['slice', ...part, '-o', file, '-q'], temporary);
  assert.equal(code, 0, error);
  return fs.readFileSync(file);
}

test(`moonraker: ${repeats} uploads of a part while it is computed`, async (t) => {
  const expected = await sliced('streamed.gcode');
  const firsts = [];
  for (let i = 0; i < repeats; i += 1) {
    const { standin, config } = await start(t, moonraker);
    // Every third upload breaks, and is computed once more.
    if (i % 3 === 2) standin.order({ cut: Math.floor(expected.length / 2) });
    const began = performance.now();
    const { code, out, error } = await run(['send', ...part, '--host', 'printer', '--start', '--json', ...quick], config);
    assert.equal(code, 0, error);
    firsts.push(((standin.began - began) / 1000).toFixed(2));
    const [[name, content]] = standin.files;
    assert.equal(name, JSON.parse(out).name);
    assert.ok(content.equals(expected), 'the bytes are those of `lamella slice`');
    assert.ok(standin.checked, 'the hash came with it');
    assert.equal(standin.starts.length, 1);
    assert.equal(JSON.parse(out).attempts, i % 3 === 2 ? 2 : 1);
    await standin.close();
  }
  console.log(`first bytes at the host after ${firsts.join(', ')} s`);
});

test('a host that asks for the size gets the same bytes, spooled and computed twice', async (t) => {
  const expected = await sliced('sized.gcode');
  for (const more of [[], ['--no-spool']]) {
    const { standin, config } = await start(t, octoprint);
    const { code, error } = await run(['send', ...part, '--host', 'printer', ...more, ...quick], config);
    assert.equal(code, 0, error);
    assert.ok([...standin.files.values()][0].equals(expected));
    assert.equal(standin.starts.length, 0, 'nothing is started unless asked');
    await standin.close();
  }
  const refused = await run(['send', '--shape', 'sphere', '--shape-radius', '4', '--printer', 'prusa-sl1s', '--host', 'octoprint+http://127.0.0.1:9', '--no-spool', '--attempts', '1'], temporary);
  assert.notEqual(refused.code, 0);
});

test('a resin file for a machine that does not know it is refused before its first byte', async (t) => {
  const { standin, config } = await start(t, hosts.find((host) => host.kind === 'sdcp'), { types: ['CTB'] });
  const { file } = makeFile('part.goo', 1000);
  const { code, error } = await run(['send', file, '--host', 'printer', ...quick], config);
  assert.equal(code, 2, error);
  assert.match(error, /accepted: \.ctb/);
  assert.equal(standin.files.size, 0);
});

test('a machine is found by the search of SDCP', async (t) => {
  await start(t, hosts.find((host) => host.kind === 'sdcp'));
  const { code, out, error } = await run(['hosts', '--find', '127.0.0.1', '--json'], temporary);
  assert.equal(code, 0, error);
  assert.deepEqual(JSON.parse(out), [{ host: 'sdcp+http://127.0.0.1', about: 'stand-in, Stand-in 8K' }]);
});

/** A certificate for 127.0.0.1, made by the machine itself. */
function makeCertificate(name) {
  const key = path.join(temporary, `${name}.key`);
  const cert = path.join(temporary, `${name}.pem`);
  execFileSync('openssl', ['req', '-x509', '-newkey', 'ec', '-pkeyopt', 'ec_paramgen_curve:prime256v1', '-nodes', '-keyout', key, '-out', cert,
    '-days', '2', '-subj', '/CN=stand-in', '-addext', 'subjectAltName=IP:127.0.0.1'], { stdio: 'ignore' });
  return { file: cert, tls: { key: fs.readFileSync(key), cert: fs.readFileSync(cert) } };
}

test('a certificate is trusted if it is the one named, and no other', async (t) => {
  const mine = makeCertificate('mine');
  const other = makeCertificate('other');
  const key = newKey();
  const standin = await moonraker.make({ key, tls: mine.tls }).listen();
  t.after(() => standin.close());
  const { file } = makeFile('secret.gcode', 1000);
  const send = (certificate) => run(['send', file, '--host', 'printer', ...quick],
    makeConfig(`[printer]\nkind = "moonraker"\nurl = "${standin.url}"\nkey = "${key}"\n${certificate ? `certificate = "${certificate}"\n` : ''}`));
  for (const certificate of ['', other.file]) {
    const { code, error } = await send(certificate);
    assert.equal(code, 2, error);
    assert.match(error, /certificate .* is not trusted/);
    assert.equal(standin.requests.length, 0, 'nothing was asked, and no key was sent');
  }
  const right = await send(mine.file);
  assert.equal(right.code, 0, right.error);
  assert.doesNotMatch(right.error, /encrypted/);
});

test('the file of hosts: rights and mistakes are told with their line', async (t) => {
  const host = '[printer]\nkind = "moonraker"\nurl = "http://127.0.0.1:9"\n';
  const cases = [
    [`${host}key = "x"\n`, 0o644, /others may read it.*chmod 600/],
    [`${host}colour = "red"\n`, 0o600, /hosts\.toml:4: `colour` is unknown; accepted: kind, url/],
    ['[printer]\nkind = "moonbaker"\nurl = "http://x"\n', 0o600, /hosts\.toml:2: kind: "moonbaker" is no kind of host; accepted: moonraker, octoprint/],
    ['[printer]\nkind = "moonraker"\nurl = "voron.local"\n', 0o600, /hosts\.toml:3: url: is no address; accepted: http:\/\/HOST/],
    ['[printer]\nkind = "moonraker"\nurl = "http://me:secret@voron"\n', 0o600, /hosts\.toml:3: url: holds a name or password/],
    ['[printer]\nkind = "moonraker"\n', 0o600, /has no `url`/],
    [`${host}key_env = "NO_SUCH_VARIABLE"\n`, 0o600, /hosts\.toml:4: key_env: the environment has no NO_SUCH_VARIABLE/],
    ['[printer\n', 0o600, /hosts\.toml:1:.*not valid TOML/],
    [`${host}key = 12\n`, 0o600, /hosts\.toml:4: key: must be a text/],
    [host, 0o600, /"voron" is unknown; accepted/],
  ];
  for (const [text, mode, expected] of cases) {
    const { code, error } = await run(['hosts', 'voron'], makeConfig(text, mode));
    assert.equal(code, 2, text);
    assert.match(error, expected);
    assert.ok(!error.includes('secret'));
  }
});

/** Ends a stand-in's print once its status was asked for. */
function endWhenSeen(standin, state) {
  const asked = standin.requests.length;
  const timer = setInterval(() => {
    if (!standin.requests.slice(asked).some((request) => request.includes('objects/query'))) return;
    clearInterval(timer);
    setTimeout(() => { standin.print.state = state; }, 100);
  }, 20);
}

test('the end of a print runs a program without a shell, and tells an address', async (t) => {
  const told = [];
  const listener = http.createServer(async (request, response) => {
    let text = '';
    for await (const part of request) text += part;
    told.push({ method: request.method, url: request.url, type: request.headers['content-type'], text });
    response.end();
  });
  await new Promise((resolve) => listener.listen(0, '127.0.0.1', resolve));
  t.after(() => listener.close());
  const { standin, config } = await start(t, moonraker, { config: `webhook = "http://127.0.0.1:${listener.address().port}/ended/"\n` });
  const name = 'a b; touch never.gcode';
  standin.print = { state: 'printing', file: name };
  const got = path.join(temporary, 'ended.txt');
  const watching = run(['watch', 'printer', '--interval', '0.05', '--json', '--', 'sh', '-c', `printf '%s %s' "$LAMELLA_STATE" "$LAMELLA_FILE" > ${got}`], config);
  endWhenSeen(standin, 'complete');
  const { code, out, error } = await watching;
  assert.equal(code, 0, error);
  assert.equal(fs.readFileSync(got, 'utf8'), `finished ${name}`);
  assert.deepEqual(told, [{
    method: 'POST', url: '/ended/', type: 'application/json', text: JSON.stringify({ host: 'printer', file: name, state: 'finished' }),
  }]);
  const states = out.trim().split('\n').map((line) => JSON.parse(line).state);
  assert.equal(states[0], 'printing');
  assert.equal(states.at(-1), 'finished');
  standin.print = { state: 'printing', file: name };
  const cancelled = run(['watch', 'printer', '--interval', '0.05'], config);
  endWhenSeen(standin, 'cancelled');
  assert.equal((await cancelled).code, 3);
});
