// The theme of the laboratory on a page beside it: the one that was chosen there, else that of the system.
(() => {
  let chosen = null;
  try {
    chosen = localStorage.getItem('quadtank-theme');
  } catch {
    // A frame without storage remembers nothing.
  }
  const dark = chosen ? chosen === 'dark' : matchMedia('(prefers-color-scheme: dark)').matches;
  document.documentElement.dataset.theme = dark ? 'dark' : 'light';
})();
