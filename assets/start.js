// Starts the laboratory, or says in both languages why it cannot start.
const say = (text) => {
  const line = document.getElementById('loading');
  if (line) {
    line.className = 'notice';
    line.textContent = text;
  }
};

if (typeof WebAssembly !== 'object') {
  say(
    'This browser has no WebAssembly, which the laboratory needs. A current Firefox, Chrome, Edge or Safari has it. · ' +
      'Este navegador não tem WebAssembly, de que o laboratório precisa. Um Firefox, Chrome, Edge ou Safari atual tem.',
  );
} else {
  try {
    const { js, wasm } = document.querySelector('script[data-wasm]').dataset;
    const laboratory = await import(new URL(js, document.baseURI));
    await laboratory.default({ module_or_path: new URL(wasm, document.baseURI) });
  } catch (error) {
    say(
      'The laboratory could not be loaded. Please reload the page. · ' +
        `Não foi possível carregar o laboratório. Por favor, recarregue a página. (${error.message})`,
    );
  }
}
