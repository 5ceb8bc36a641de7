/** Requests that are tried again while the server does not answer, and events of a run. */

const PAUSES = [250, 500, 1000]; // the last again and again

/** Says how the connection is, in the head of the page; "" where all is well. */
export function sayConnection(text) {
  const place = document.getElementById("connection");
  if (place.textContent !== text) place.textContent = text;
}

/** An answer that is no answer to what was asked, with the words of the server. */
export class Refused extends Error {
  constructor(status, text) {
    super(text);
    this.status = status;
  }
}

export function pause(time, signal) {
  return new Promise((resolve, reject) => {
    const timer = setTimeout(resolve, time);
    signal?.addEventListener("abort", () => {
      clearTimeout(timer);
      reject(signal.reason);
    }, { once: true });
  });
}

/** The whole answer to a request, which is tried again until there is one. Throws Refused, or what the signal says. */
export async function ask(path, { signal, ...options } = {}) {
  for (let attempt = 0; ; attempt += 1) {
    let answer = null;
    try {
      answer = await wholeAnswer(await fetch(path, { signal, ...options }));
    } catch (error) {
      if (signal?.aborted) throw error;
    }
    if (answer && ![502, 503, 504].includes(answer.status)) {
      sayConnection(answer.status === 403
        ? "Signed out: open the address that lasersph serve printed last." : "");
      if (answer.ok) return answer;
      throw new Refused(answer.status, await wordsOf(answer));
    }
    sayConnection("The server does not answer; trying again.");
    await pause(PAUSES[Math.min(attempt, PAUSES.length - 1)], signal);
  }
}

/** The same answer once all of it has come: one that breaks off is none. */
async function wholeAnswer(answer) {
  const body = await answer.blob();
  return new Response(body.size ? body : null, answer);
}

async function wordsOf(answer) {
  const text = await answer.text();
  try {
    return JSON.parse(text).error ?? text;
  } catch {
    return text;
  }
}

export async function getJson(path, options) {
  return (await ask(path, options)).json();
}

/** Calls `tell(sizes)` for every event of a run, with a new connection whenever one ends. */
export function listen(id, tell, signal) {
  let source = null, timer = 0;
  const open = () => {
    clearTimeout(timer);
    source?.close();
    if (signal.aborted || document.hidden) return;
    source = new EventSource(`api/run/${id}/live`);
    source.onmessage = (event) => {
      if (signal.aborted) return;
      sayConnection("");
      tell(JSON.parse(event.data));
    };
    source.onerror = () => {
      if (signal.aborted) return;
      source.close();
      // a plain request tells why, and says when the server is back
      ask("api/alive", { signal }).then(() => {
        timer = setTimeout(open, PAUSES[0]);
      }, () => {});
    };
  };
  const close = () => {
    clearTimeout(timer);
    source?.close();
    document.removeEventListener("visibilitychange", open);
  };
  document.addEventListener("visibilitychange", open); // a browser has few connections for many pages
  window.addEventListener("pagehide", () => source?.close(), { signal });
  signal.addEventListener("abort", close, { once: true });
  open();
}
