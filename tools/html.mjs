// What the steps after Trunk ask of the page: its policy, and that nothing in it is inline.
import { createHash } from 'node:crypto';

/** The content security policy of the site, for a meta tag (`frame-ancestors` would need a header). */
export const SITE_POLICY = [
  "default-src 'none'",
  "script-src 'self' 'wasm-unsafe-eval'",
  "style-src 'self'",
  "img-src 'self' data: blob:",
  "connect-src 'self'",
  // The page for teachers shows the embed that it makes.
  "frame-src 'self'",
  "worker-src 'self'",
  "manifest-src 'self'",
  "base-uri 'none'",
  "form-action 'none'",
].join('; ');

/** Puts the policy where it holds for all that follows: right after the character set. */
export function withPolicy(html, policy) {
  const charset = /<meta charset="utf-8"\s*\/?>/i;
  return replaceOnce(html, charset, (tag) => `${tag}<meta http-equiv="Content-Security-Policy" content="${policy}">`);
}

/** Everything in the page that the policy of the site would refuse. */
export function inlineParts(html) {
  const scripts = html.match(/<script\b(?![^>]*\ssrc=)[^>]*>/gi) ?? [];
  const styles = html.match(/<style\b[^>]*>/gi) ?? [];
  const attributes = html.match(/<[a-z][^<>]*\s(?:style|on[a-z]+)\s*=[^<>]*>/gi) ?? [];
  return [...scripts, ...styles, ...attributes];
}

/** Replaces the only match; anything but one match means that the input is no longer what this step was written for. */
export function replaceOnce(text, pattern, replacement) {
  const count = [...text.matchAll(new RegExp(pattern, pattern.flags.replace('g', '') + 'g'))].length;
  if (count !== 1) throw new Error(`expected one match of ${pattern}, found ${count}`);
  return text.replace(pattern, replacement);
}

/** How a policy names an inline script or style. */
export const hashOf = (text) => `'sha256-${createHash('sha256').update(text).digest('base64')}'`;

/** Ends a build step with a sentence instead of a stack. */
export function fail(sentence) {
  console.error(sentence);
  process.exit(1);
}
