// Starts the laboratory. Says in both languages why it cannot start, and shows the notice of a laboratory that has stopped.

/** Shows a sentence where the one about loading stands, or stood. */
const say = (text) => {
  const line = document.getElementById('loading') ?? document.body.appendChild(document.createElement('p'));
  line.className = 'notice';
  line.setAttribute('role', 'alert');
  line.textContent = text;
  document.getElementById('late')?.remove();
};

/** Whether an error ends the program: a trap of the wasm, or a full stack (RangeError, in Firefox InternalError). */
const isFatal = (error) => ['RuntimeError', 'RangeError', 'InternalError'].includes(error?.name);

/** Begins without the experiment in the address, which may be what the laboratory stopped at. */
const startAgain = () => {
  try {
    history.replaceState(null, '', location.href.split('#')[0]);
  } catch {
    // A sandboxed page may not touch its address.
  }
  location.reload();
};

/** After a trap nothing of the page reacts; the notice that it keeps for this (src/stopped.rs) needs no program. */
const stop = (error) => {
  if (!isFatal(error)) return;
  const notice = document.getElementById('stopped');
  if (!notice) {
    say(
      'The laboratory stopped at an error in its program. Please reload the page; if you came by a link, remove what stands after # in the address. · ' +
        'O laboratório parou por um erro em seu programa. Por favor, recarregue a página; se você veio por um link, apague o que vem depois de # no endereço. · ' +
        'El laboratorio se detuvo por un error de su programa. Por favor, recarga la página; si llegaste por un enlace, borra lo que sigue a # en la dirección.',
    );
  } else if (notice.hidden) {
    for (const part of notice.parentElement.children) part.inert = part !== notice;
    notice.hidden = false;
    document.getElementById('again').addEventListener('click', startAgain);
    // A link that is pasted into the address has nobody to open it but a new start.
    addEventListener('hashchange', () => location.reload());
  }
};

if (typeof WebAssembly !== 'object') {
  say(
    'This browser has no WebAssembly, which the laboratory needs. A current Firefox, Chrome, Edge or Safari has it. · ' +
      'Este navegador não tem WebAssembly, de que o laboratório precisa. Um Firefox, Chrome, Edge ou Safari atual tem. · ' +
      'Este navegador no tiene WebAssembly, que el laboratorio necesita. Un Firefox, Chrome, Edge o Safari actual lo tiene.',
  );
} else {
  addEventListener('error', (event) => stop(event.error));
  addEventListener('unhandledrejection', (event) => stop(event.reason));
  try {
    const { js, wasm } = document.querySelector('script[data-wasm]').dataset;
    const laboratory = await import(new URL(js, document.baseURI));
    await laboratory.default({ module_or_path: new URL(wasm, document.baseURI) });
  } catch (error) {
    if (isFatal(error)) stop(error);
    else
      say(
        'The laboratory could not be loaded. Please reload the page. · ' +
          `Não foi possível carregar o laboratório. Por favor, recarregue a página. · ` +
          `No se pudo cargar el laboratorio. Por favor, recarga la página. (${error.message})`,
      );
  }
}
