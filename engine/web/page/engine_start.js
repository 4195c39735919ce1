// Of pages whose cells run: the engine is fetched and compiled while the page itself is still read.
import { canRun, engine } from "./engine.js";

if (canRun()) engine.begin().catch(() => {});  // the page begins it again, and says what is wrong
