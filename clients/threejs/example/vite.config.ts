import { defineConfig } from "vite";

export default defineConfig({
  base: "./",
  build: { chunkSizeWarningLimit: 1000 }, // three is most of it
  resolve: { alias: { "@nacreous/three": new URL("../src/index.ts", import.meta.url).pathname } },
});
