// @ts-check
import { byId } from "../dom.js";
import { shortcutList } from "./shortcuts.js";

byId("shortcuts").append(...shortcutList(null));
