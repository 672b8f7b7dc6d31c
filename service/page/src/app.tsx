/** The page: what is where. */

import type { ComponentType } from "preact";
import { useEffect, useState } from "preact/hooks";

import { Certificate } from "./panels/certificate";
import { Downloads } from "./panels/downloads";
import { Gallery } from "./panels/gallery";
import { Header } from "./panels/header";
import { Layers } from "./panels/layers";
import { LinkNotice } from "./panels/link-notice";
import { Notice } from "./panels/notice";
import { SkipToFilm } from "./panels/skip-to-film";
import { SurfacePanel } from "./panels/surface-panel";
import { ChromaticityPlot } from "./plots/chromaticity-plot";
import { ColourStrip } from "./plots/colour-strip";
import { LobePlot } from "./plots/lobe-plot";
import { SpectrumPlot } from "./plots/spectrum-plot";
import { followSpec } from "./state/lookup";
import { followLink } from "./state/permalink";

export function App() {
  useEffect(() => void followLink().then(followSpec), []);
  return (
    <>
      <SkipToFilm />
      <Header />
      <Notice />
      <LinkNotice />
      <Gallery />
      <main class="bench">
        <div class="view">
          <LatePreview />
        </div>
        <div class="film">
          <Layers />
          <SurfacePanel />
        </div>
        <div class="plots">
          <ColourStrip />
          <SpectrumPlot />
          <ChromaticityPlot />
          <LobePlot />
        </div>
        <div class="files">
          <Certificate />
          <Downloads />
        </div>
      </main>
    </>
  );
}

/** The preview's code is most of the page's weight: it comes once everything else can be read. */
function LatePreview() {
  const [loaded, setLoaded] = useState<{ readonly Preview: ComponentType }>();
  useEffect(() => void import("./preview/preview").then(setLoaded), []);
  return loaded ? <loaded.Preview /> : <div class="awaited-preview" />;
}
