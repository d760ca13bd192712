// Every host against its stand-in: files whole, prints started once, whatever breaks.
import assert from 'node:assert/strict';
import fs from 'node:fs';
import path from 'node:path';
import { test } from 'node:test';
import { hosts, makeFile, makeRandom, quick, run, start } from './program.mjs';

const runs = Number(process.env.LAMELLA_HOST_FAULTS ?? 12);
const nameOf = (host) => host.label ?? host.kind;

/** The only file of a stand-in. */
function onlyFile(standin) {
  assert.equal(standin.files.size, 1, `files: ${[...standin.files.keys()]}`);
  return [...standin.files.values()][0];
}

for (const host of hosts) {
  test(`${nameOf(host)}: a file is sent, printed, paused, resumed, cancelled`, { concurrency: true }, async (t) => {
    const { standin, config } = await start(t, host);
    const { file, bytes } = makeFile(`part-${nameOf(host)}${host.ending}`, 2_500_000);
    const first = await run(['send', file, '--host', 'printer', '--start', '--json', ...quick], config);
    assert.equal(first.code, 0, first.error);
    assert.ok(onlyFile(standin).equals(bytes), 'the bytes are the file\'s');
    assert.equal(standin.starts.length, 1);
    assert.equal(JSON.parse(first.out).bytes, bytes.length);
    assert.match(first.error, /nothing is encrypted/);
    assert.ok(!standin.wasted, 'no body is sent before the host knows who asks');

    const again = await run(['send', file, '--host', 'printer', '--start', '--json', ...quick], config);
    assert.equal(again.code, 0, again.error);
    assert.equal(standin.starts.length, 1, 'a second call starts nothing');
    assert.equal(JSON.parse(again.out).prints, true);

    const watch = (...args) => run(['watch', 'printer', '--json', ...args], config);
    const states = [];
    for (const args of [['--once'], ['--pause'], ['--resume'], ['--cancel']]) {
      const { code, out, error } = await watch(...args);
      assert.equal(code, 0, error);
      states.push(JSON.parse(out).state);
    }
    // One host does not tell a print that was cancelled from one that never was.
    const ended = { octoprint: 'idle', nanodlp: 'idle' }[host.kind] ?? 'cancelled';
    assert.deepEqual(states, ['printing', 'paused', 'printing', ended]);
  });

  test(`${nameOf(host)}: the way to it is tested`, { concurrency: true }, async (t) => {
    const { standin, config } = await start(t, host);
    const { code, out, error } = await run(['hosts', 'printer', '--json'], config);
    assert.equal(code, 0, error);
    const facts = JSON.parse(out);
    assert.equal(facts.kind, host.kind);
    assert.equal(facts.encrypted, false);
    assert.equal(facts.status.state, 'idle');
    if (host.kind !== 'nanodlp') assert.equal(facts.free_bytes, 1e9);
  });

  test(`${nameOf(host)}: another print is not disturbed, a lack of room is told`, { concurrency: true }, async (t) => {
    const { standin, config } = await start(t, host, { free: 1000 });
    const { file } = makeFile(`big-${nameOf(host)}${host.ending}`, 5000);
    if (host.kind !== 'nanodlp') {
      const full = await run(['send', file, '--host', 'printer', ...quick], config);
      assert.equal(full.code, 2);
      assert.match(full.error, /room for 1,000/);
      assert.equal(standin.files.size, 0);
    }
    standin.options.free = 1e9;
    standin.print = { state: 'printing', file: `other${host.ending}` };
    const busy = await run(['send', file, '--host', 'printer', '--start', ...quick], config);
    assert.equal(busy.code, 2, busy.error);
    assert.match(busy.error, /is printing .*other/);
    assert.equal(standin.starts.length, 0);
  });

  if (host.key) {
    test(`${nameOf(host)}: a wrong key is told, and a key never`, { concurrency: true }, async (t) => {
      const { standin, config, key } = await start(t, host);
      const { file } = makeFile(`keyed-${nameOf(host)}${host.ending}`, 300_000);
      const wrong = await run(['send', file, '--host', 'printer', ...quick], config, { environment: { LAMELLA_HOST_KEY: 'wrong-key' } });
      assert.equal(wrong.code, 2, wrong.error);
      assert.match(wrong.error, /refuses the (key|password)/);
      assert.ok(!wrong.error.includes('wrong-key'));
      standin.order({ slow: 700 });
      let seen = '';
      const right = await run(['send', file, '--host', 'printer', '--start', '--json', ...quick], config, {
        whileRunning: () => setTimeout(() => {
          for (const process of fs.readdirSync('/proc').filter((entry) => /^\d+$/.test(entry))) {
            try {
              seen += fs.readFileSync(path.join('/proc', process, 'cmdline'), 'utf8');
            } catch { /* has ended */ }
          }
        }, 300),
      });
      assert.equal(right.code, 0, right.error);
      assert.ok(seen.includes('--host'), 'the program was seen while it ran');
      for (const text of [right.out, right.error, seen]) assert.ok(!text.includes(key), 'the key is nowhere to be seen');
      await standin.close();
    });
  }

  test(`${nameOf(host)}: ${runs} runs with faults`, { concurrency: true }, async (t) => {
    const random = makeRandom(45 + nameOf(host).length);
    const pick = (list) => list[Math.floor(random() * list.length)];
    const tally = {};
    for (let i = 0; i < runs; i += 1) {
      const { standin, config } = await start(t, host);
      const size = 1 + Math.floor(random() * 400_000);
      const { file, bytes } = makeFile(`fault-${nameOf(host)}${host.ending}`, size, random);
      const kind = pick(['cut', 'cut', 'cut', '401', '411', '413', '422', '503', 'slow', 'damage', 'restart', 'mute', 'start503', 'startMute', 'startCut', 'status503']);
      const times = 1 + Math.floor(random() * 3);
      const final = ['401', '411', '413'].includes(kind);
      if (kind === 'cut') standin.order({ cut: 1 + Math.floor(random() * size), times });
      else if (final) standin.order({ status: Number(kind), times: 100 });
      else if (kind === '422' || kind === '503') standin.order({ status: Number(kind), times });
      else if (kind === 'slow') standin.order({ slow: 200, times });
      else if (kind === 'damage') standin.order({ damage: true, times });
      else if (kind === 'restart') standin.order({ restart: 60, on: pick(['upload', 'status']) });
      else if (kind === 'mute') standin.order({ mute: true, times });
      else if (kind === 'start503') standin.order({ status: 503, times, on: 'start' });
      else if (kind === 'startMute') standin.order({ mute: true, on: 'start' });
      else if (kind === 'startCut') standin.order({ restart: 60, on: 'start' });
      else if (kind === 'status503') standin.order({ status: 503, times, on: 'status' });
      const { code, out, error } = await run(['send', file, '--host', 'printer', '--start', '--json', ...quick], config);
      const told = `run ${i}, ${kind} x${times}, ${size} bytes: exit ${code}, ${standin.starts.length} starts\n${error}`;

      assert.ok(standin.starts.length <= 1, `started twice: ${told}`);
      for (const begun of standin.starts) assert.equal(begun.size, size, `a truncated file was started: ${told}`);
      if (standin.starts.length > 0) assert.ok(onlyFile(standin).equals(bytes), `another file was started: ${told}`);
      if (code === 0) {
        assert.equal(standin.starts.length, 1, told);
        assert.equal(JSON.parse(out).started, true, told);
      } else {
        assert.match(error, /lamella: /, told);
      }
      // What passes is lived through; what does not is told. A start whose answer is lost before it happened
      // is the one thing that only a person can decide.
      if (final) assert.ok(code !== 0 && standin.starts.length === 0, told);
      else if (kind !== 'startCut' && !(host.kind === 'sdcp' && kind === 'start503')) assert.equal(code, 0, told);
      tally[`${kind} ${code === 0 ? 'done' : 'told'}`] = (tally[`${kind} ${code === 0 ? 'done' : 'told'}`] ?? 0) + 1;
      await standin.close();
    }
    console.log(`${nameOf(host)}: ${Object.entries(tally).map(([key, count]) => `${key} ${count}`).join(', ')}`);
  });
}
