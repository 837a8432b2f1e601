import { resolve } from "node:path";
import { defineConfig } from "vite";

// `vite build --mode station` builds index.html into station.js and station.css beside the Python server; another page is
// built by a call with its own mode, so that no chunk is shared. All names are fixed: the server knows them.
const pages: Record<string, string> = { station: "index.html", experimenter: "experimenter.html" };

export default defineConfig(({ mode }) => ({
  base: "./",
  worker: { rolldownOptions: { output: { entryFileNames: "worker.js" } } },
  build: {
    outDir: resolve(import.meta.dirname, "../src/holdfast/teleop/serve/static"),
    emptyOutDir: false,
    target: "es2022",
    modulePreload: false,
    assetsInlineLimit: 0,
    sourcemap: false,
    rolldownOptions: {
      input: pages[mode] ?? "index.html",
      output: {
        entryFileNames: `${mode}.js`,
        chunkFileNames: `${mode}-[name].js`,
        assetFileNames: `${mode}[extname]`,
        codeSplitting: false,
      },
    },
  },
}));
