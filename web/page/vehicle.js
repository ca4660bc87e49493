// SPDX-License-Identifier: Apache-2.0
// Changes of the vehicle: requests to navcald's control socket through /control. The token is typed once and kept for
// this browser tab.

const KEY = 'navcal-token';
const ANSWER_MS = 5000;

// A page in a frame of another site may have no storage.
const storage = {
  get() {
    try {
      return sessionStorage.getItem(KEY);
    } catch {
      return null;
    }
  },
  set(token) {
    try {
      if (token == null) sessionStorage.removeItem(KEY);
      else sessionStorage.setItem(KEY, token);
    } catch {
      // Then it is typed again after a reload.
    }
  },
};

export class Vehicle extends EventTarget {
  constructor(store) {
    super();
    this.store = store;
    this.waiting = [];
    this.isOpen = false;
    this.why = '';
    this.token = storage.get();
    store.addEventListener('snapshot', () => {
      this.dispatchEvent(new Event('change'));
      if (this.token != null && !this.socket && store.about.can_change) this.unlock(this.token);
    });
  }

  // Why nothing can be changed now; empty when it can.
  refusal() {
    if (this.store.about.recording) return 'A recording cannot be changed.';
    if (!this.store.about.can_change) return 'This server may only be looked at: it was started without a token.';
    if (this.isOpen) return '';
    return this.why || 'Changes need the token (Remote control).';
  }

  unlock(token) {
    this.socket?.close();
    this.why = 'The token is being checked.';
    const url = new URL('control', document.baseURI);
    url.protocol = url.protocol === 'https:' ? 'wss:' : 'ws:';
    const socket = new WebSocket(url);
    this.socket = socket;
    socket.onopen = () => this.#request({token}).then((answer) => {
      if (!answer.ok) return;
      this.isOpen = true;
      this.why = '';
      this.token = token;
      storage.set(token);
      this.dispatchEvent(new Event('change'));
    });
    let refused = '';
    socket.onmessage = (message) => {
      const answer = JSON.parse(message.data);
      if (!answer.ok && !this.isOpen) refused = answer.error;
      if (!answer.ok && this.waiting.length === 0) refused = answer.error;
      this.waiting.shift()?.(answer);
    };
    socket.onclose = (end) => {
      if (socket !== this.socket) return;
      const wasOpen = this.isOpen;
      this.socket = null;
      this.isOpen = false;
      for (const answer of this.waiting.splice(0)) answer({ok: false, error: 'the connection ended'});
      this.why = `No changes: ${refused || end.reason || 'the control connection ended'}.`;
      if (!wasOpen && /token/.test(refused)) this.forget();
      else if (wasOpen) setTimeout(() => !this.socket && this.token != null && this.unlock(this.token), 1000);
      this.dispatchEvent(new Event('change'));
    };
    this.dispatchEvent(new Event('change'));
  }

  forget() {
    this.token = null;
    storage.set(null);
  }

  lock() {
    this.forget();
    this.socket?.close(1000);
  }

  async ask(request) {
    const why = this.refusal();
    return why === '' ? this.#request(request) : {ok: false, error: why};
  }

  #request(request) {
    return new Promise((resolve) => {
      const timer = setTimeout(() => resolve({ok: false, error: 'no answer within 5 s'}), ANSWER_MS);
      this.waiting.push((answer) => {
        clearTimeout(timer);
        resolve(answer);
      });
      this.socket.send(JSON.stringify(request));
    });
  }
}
