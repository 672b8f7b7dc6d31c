import { render } from "preact";

import { App } from "./app";
import "./style/page.css";

const root = document.getElementById("page");
if (!root) throw new Error("expected an element of the id page in index.html");
render(<App />, root);
