import { fileURLToPath } from "node:url";

import { defineConfig } from "vite";

export default defineConfig({
  base: "./",
  resolve: {
    alias: { "@nacreous/three": fileURLToPath(new URL("../../clients/threejs/src/index.ts", import.meta.url)) },
    dedupe: ["three"], // the client's own imports are this page's three
  },
  build: {
    outDir: "../nacreous/web/page",
    emptyOutDir: true,
    assetsInlineLimit: 0, // the page's policy allows no data: addresses
    chunkSizeWarningLimit: 1000, // three is most of it
  },
  // `npm run dev` beside `make serve`: the page comes from here, and what it asks for from the service
  server: { proxy: Object.fromEntries(["/v1", "/healthz", "/docs", "/openapi.json"].map((path) => [path, "http://localhost:8000"])) },
});
