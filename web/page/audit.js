// SPDX-License-Identifier: Apache-2.0
// Sends a log to navcal-web, which audits it, and shows the page that comes back.
import {$, make, write} from './dom.js';

const PIECE_BYTES = 64 << 10;
let socket = null;

function end(text) {
  socket?.close();
  socket = null;
  write($('state'), text);
  $('running').hidden = true;
  $('file').value = '';
}

// Its own document takes the place of this one: what is looked at, printed and saved is the audit alone.
function show(page, name) {
  const audit = new DOMParser().parseFromString(page, 'text/html');
  const save = make('a', {href: URL.createObjectURL(new Blob([page], {type: 'text/html'})), download: `${name}.html`}, 'Save this page');
  const bar = make('p', {id: 'bar'}, save, ' \u2013 ', make('a', {href: 'audit.html'}, 'Audit another log'), make('style', {}, '@media print { #bar { display: none; } }'));
  audit.querySelector('main').prepend(bar);
  document.replaceChild(document.adoptNode(audit.documentElement), document.documentElement);
}

async function audit(file) {
  end(`Reading ${file.name}`);
  $('running').hidden = false;
  const url = new URL('audit', document.baseURI);
  url.protocol = url.protocol === 'https:' ? 'wss:' : 'ws:';
  const mine = new WebSocket(url);
  socket = mine;
  mine.binaryType = 'arraybuffer';
  mine.onopen = () => mine.send(JSON.stringify({name: file.name, bytes: file.size}));
  mine.onmessage = async ({data}) => {
    if (mine !== socket) return;
    if (typeof data !== 'string') {
      mine.onclose = null;
      return show(new TextDecoder().decode(data), file.name);
    }
    const {received, progress, error} = JSON.parse(data);
    if (error) return end(`${file.name}: ${error}`);
    if (progress) return write($('state'), progress.replace(/^navcal audit/, file.name));
    $('progress').value = received / file.size;
    if (received === file.size) return write($('state'), `${file.name}: looking for faults`);
    try {
      const piece = await file.slice(received, received + PIECE_BYTES).arrayBuffer();
      if (mine === socket) mine.send(piece);
    } catch (problem) {
      end(`${file.name}: it cannot be read: ${problem.message}`);
    }
  };
  mine.onclose = () => mine === socket && end(`${file.name}: navcal-web does not answer`);
}

$('file').addEventListener('change', () => $('file').files.length && audit($('file').files[0]));
$('cancel').addEventListener('click', () => end('Cancelled.'));
for (const kind of ['dragover', 'drop']) {
  window.addEventListener(kind, (event) => {
    event.preventDefault();
    if (kind === 'drop' && $('drop') && event.dataTransfer.files.length) audit(event.dataTransfer.files[0]);
  });
}
