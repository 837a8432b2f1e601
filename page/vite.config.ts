import { resolve } from "node:path";
import { defineConfig, type UserConfig } from "vite";

// `vite build --mode station` builds index.html into station.js and station.css beside the Python server; another page is
// built by a call with its own mode, so that no chunk is shared. All names are fixed: the server knows them.
const pages: Record<string, string> = { station: "index.html", experimenter: "experimenter.html" };

// `vite build --mode viewer` builds the small 3-D view that reports and notebooks hold, and `--mode arm_page` the page of an
// arm: one script each, which runs where it is put.
const script = (folder: string): UserConfig => ({
  publicDir: false,
  build: {
    outDir: resolve(import.meta.dirname, "../src/holdfast/interface/report/templates"),
    emptyOutDir: false,
    target: "es2022",
    lib: { entry: `src/${folder}/main.ts`, formats: ["iife"], name: "holdfastView", fileName: () => `${folder}.js` },
  },
});

export default defineConfig(({ mode }) => mode === "viewer" || mode === "arm_page" ? script(mode) : ({
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
