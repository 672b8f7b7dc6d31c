import { defineConfig } from "vite";

export default defineConfig({
  base: "./",
  resolve: {
    alias: { "@nacreous/three": new URL("../../clients/threejs/src/index.ts", import.meta.url).pathname },
    dedupe: ["three"], // the client's own imports are this page's three
  },
  build: {
    outDir: "../nacreous/web/page",
    emptyOutDir: true,
    assetsInlineLimit: 0, // the page's policy allows no data: addresses
    chunkSizeWarningLimit: 1000, // three is most of it
  },
  server: { proxy: { "/v1": "http://localhost:8000", "/healthz": "http://localhost:8000" } },
});
