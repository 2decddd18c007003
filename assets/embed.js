// <quadtank-lab>: the laboratory in a course page.
//   <script type="module" src="https://…/embed.js"></script>
//   <quadtank-lab lesson="two-valves-one-zero" lang="en"></quadtank-lab>
//   <quadtank-lab bench="quadruple-tank" preset="johansson-2000-minimum-phase" panels="valves,zeros" lock="gains"></quadtank-lab>
// The frame grows with its content. Events: quadtank-ready, quadtank-state, quadtank-answer, quadtank-score (detail: the message).
const HERE = new URL('./', import.meta.url);
const FLAGS = ['bench', 'preset', 'panels', 'lock', 'lesson', 'step', 'lang', 'theme', 'view'];

customElements.define(
  'quadtank-lab',
  class extends HTMLElement {
    static observedAttributes = [...FLAGS, 'state'];

    /** How large all in the frame is: 1.5 on a projector. What is scaled is laid out as in a smaller window, as by the zoom of a browser. */
    get scale() {
      return Math.min(Math.max(Number(this.getAttribute('scale')) || 1, 0.25), 4);
    }

    /** The height of the content (CSS px of the frame). */
    resize(height) {
      const { scale } = this;
      const style = { width: `${100 / scale}%`, height: `${height}px`, transform: `scale(${scale})`, marginBottom: `${(scale - 1) * height}px` };
      Object.assign(this.frame.style, style);
    }

    connectedCallback() {
      this.frame = document.createElement('iframe');
      this.frame.title = this.getAttribute('title') ?? 'Quadtank';
      this.frame.allow = 'clipboard-write';
      Object.assign(this.frame.style, { border: '0', transformOrigin: '0 0' });
      this.resize(Number(this.getAttribute('height')) / this.scale || 720);
      this.listener = (event) => this.hear(event);
      addEventListener('message', this.listener);
      this.show();
      this.replaceChildren(this.frame);
    }

    disconnectedCallback() {
      removeEventListener('message', this.listener);
    }

    attributeChangedCallback() {
      if (this.frame) this.show();
    }

    show() {
      const flags = new URLSearchParams({ embed: '1', origins: location.origin });
      if (!this.hasAttribute('height')) flags.set('grows', '1');
      for (const flag of FLAGS) if (this.hasAttribute(flag)) flags.set(flag, this.getAttribute(flag));
      const state = this.getAttribute('state');
      this.frame.src = `${HERE}?${flags}${state ? `#lab=${state}` : ''}`;
    }

    hear(event) {
      if (event.source !== this.frame.contentWindow || event.origin !== HERE.origin || event.data?.quadtank === undefined) return;
      const { quadtank: kind, ...detail } = event.data;
      if (kind === 'height' && !this.hasAttribute('height')) this.resize(detail.height);
      this.dispatchEvent(new CustomEvent(`quadtank-${kind}`, { detail, bubbles: true }));
    }

    /** Opens a state: what follows #lab= in an address of the laboratory. */
    open(state) {
      this.frame.contentWindow.postMessage({ quadtank: 'open', state }, HERE.origin);
    }
  },
);
