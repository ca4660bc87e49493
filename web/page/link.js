// SPDX-License-Identifier: Apache-2.0
// The connection to the server: a WebSocket that connects again by itself; where none gets through (some proxies),
// the page asks for a snapshot once a second.

const SILENCE_MS = 4000; // the server speaks at least once a second
const RETRY_MS = [250, 500, 1000, 2000];
const POLL_MS = 1000;

export class Link extends EventTarget {
  constructor(store) {
    super();
    this.store = store;
    this.state = 'connecting'; // connecting, open, polling, lost
    this.why = '';
    this.heard = null;
    this.attempts = 0;
    this.everOpen = false;
    this.socket = null;
    setInterval(() => this.#watch(), 500);
    document.addEventListener('visibilitychange', () => {
      if (document.visibilityState === 'visible' && this.state === 'lost') this.#connect();
    });
    this.#connect();
  }

  send(object) {
    if (this.socket?.readyState === WebSocket.OPEN) this.socket.send(JSON.stringify(object));
  }

  #set(state, why = '') {
    if (state === this.state && why === this.why) return;
    this.state = state;
    this.why = why;
    this.dispatchEvent(new Event('change'));
  }

  #take(text) {
    this.heard = performance.now();
    try {
      this.store.take(text);
    } catch (error) {
      console.error(error);
    }
  }

  #connect() {
    clearTimeout(this.timer);
    this.socket?.close();
    const url = new URL('live', document.baseURI);
    url.protocol = url.protocol === 'https:' ? 'wss:' : 'ws:';
    const socket = new WebSocket(url);
    this.socket = socket;
    let opened = false;
    socket.onopen = () => {
      opened = true;
      clearTimeout(this.timer);
      this.everOpen = true;
      this.attempts = 0;
      this.heard = performance.now();
      this.#set('open');
    };
    socket.onmessage = (message) => this.#take(message.data);
    socket.onclose = (end) => {
      if (socket !== this.socket) return;
      this.socket = null;
      ++this.attempts;
      if (!opened && !this.everOpen && this.attempts >= 2) this.#poll();
      else this.#lose(end.reason || 'the server does not answer');
    };
  }

  #lose(why) {
    this.#set('lost', why);
    this.timer = setTimeout(() => this.#connect(), RETRY_MS[Math.min(this.attempts, RETRY_MS.length) - 1] ?? 250);
  }

  async #poll() {
    clearTimeout(this.timer);
    try {
      const answer = await fetch('live.json', {cache: 'no-store', signal: AbortSignal.timeout(SILENCE_MS)});
      if (!answer.ok) throw new Error(`the server answers ${answer.status}`);
      this.#take(await answer.text());
      this.#set('polling');
    } catch (error) {
      this.#set('lost', error.message);
    }
    // A WebSocket may get through later.
    if (++this.attempts % 30 === 0) this.#connect();
    this.timer = setTimeout(() => this.#poll(), POLL_MS);
  }

  #watch() {
    if (this.socket?.readyState !== WebSocket.OPEN || performance.now() - this.heard < SILENCE_MS) return;
    const silent = this.socket;
    this.socket = null;
    silent.close();
    this.attempts = 1;
    this.#lose('the server is silent');
  }

  silence() {
    return this.heard == null ? null : (performance.now() - this.heard) / 1000;
  }
}
