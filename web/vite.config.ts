import { defineConfig } from 'vite';

export default defineConfig({
  // The service's policy allows files of its own only, nothing inline.
  build: {
    target: 'es2023',
    cssTarget: 'chrome125',
    assetsInlineLimit: 0,
    modulePreload: { polyfill: false },
    reportCompressedSize: true,
  },
  server: { proxy: { '/v1': process.env.PLENUM_SERVICE ?? 'http://127.0.0.1:8080' } },
});
