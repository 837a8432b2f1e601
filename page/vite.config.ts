import { resolve } from "node:path";
import { defineConfig, type UserConfig } from "vite";

// `vite build --mode station` builds index.html into station.js and station.css beside the Python server; another page is
// built by a call with its own mode, so that no chunk is shared. All names are fixed: the server knows them.
const pages: Record<string, string> = { station: "index.html", experimenter: "experimenter.html" };

// `vite build --mode viewer` builds the small 3-D view that reports and notebooks hold, `--mode arm_page` the page of an arm,
// `--mode any_arm` its part for URDF files, and `--mode studio` the page of the studio: one script each, which runs where it is.
const scripts: Record<string, string> = {
  viewer: "src/viewer/main.ts",
  arm_page: "src/arm_page/main.ts",
  any_arm: "src/arm_page/any_arm.ts",
  studio: "src/arm_page/studio.ts",
};
const script = (name: string): UserConfig => ({
  publicDir: false,
  build: {
    outDir: resolve(import.meta.dirname, "../src/holdfast/interface/report/templates"),
    emptyOutDir: false,
    target: "es2022",
    lib: { entry: scripts[name], formats: ["iife"], name: "holdfastView", fileName: () => `${name}.js` },
  },
});

export default defineConfig(({ mode }) => mode in scripts ? script(mode) : ({
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
