-- What formulas may be written with. Everything else is refused: TeX runs a control word whatever it does, and
-- \begin{NAME} runs \NAME, so that no list of what is dangerous could ever be whole. Nothing here makes or names a
-- macro, changes what a character means, or reaches a file.
local mathematics = {}

-- Commands without arguments: the symbols of LaTeX, amssymb, amsmath and mathtools.
mathematics.symbols = [[
  aleph alpha amalg angle approx approxeq ast asymp backepsilon backprime backsim backsimeq backslash barwedge Bbbk
  because beta beth between bigcap bigcirc bigcup bigodot bigoplus bigotimes bigsqcup bigstar bigtimes
  bigtriangledown bigtriangleup biguplus bigvee bigwedge blacklozenge blacksquare blacktriangle blacktriangledown
  blacktriangleleft blacktriangleright bot bowtie Box boxdot boxminus boxplus boxtimes bullet Bumpeq bumpeq Cap cap
  cdot cdots centerdot checkmark chi circ circeq circlearrowleft circlearrowright circledast circledcirc circleddash
  circledR circledS clubsuit colon Colonapprox colonapprox Coloneq coloneq Coloneqq coloneqq Colonsim colonsim
  complement cong coprod copyright Cup cup curlyeqprec curlyeqsucc curlyvee curlywedge curvearrowleft
  curvearrowright dag dagger daleth dashleftarrow dashrightarrow dashv dblcolon ddag ddagger ddots Delta delta
  diagdown diagup Diamond diamond diamondsuit digamma div divideontimes Doteq doteq doteqdot dotplus dots dotsb
  dotsc dotsi dotsm dotso doublebarwedge doublecap doublecup Downarrow downarrow downdownarrows downharpoonleft
  downharpoonright ell emptyset epsilon eqcirc Eqcolon eqcolon Eqqcolon eqqcolon eqsim eqslantgtr eqslantless equiv
  eta eth exists fallingdotseq Finv flat forall frown Game Gamma gamma ge geq geqq geqslant gets gg ggg gimel
  gnapprox gneq gneqq gnsim gtrapprox gtrdot gtreqless gtreqqless gtrless gtrsim gvertneqq hbar heartsuit
  hookleftarrow hookrightarrow hslash idotsint iff iiiint iiint iint Im imath impliedby implies in infty int
  intercal iota jmath Join kappa Lambda lambda land langle lbrace lbrack lceil ldots le leadsto Leftarrow leftarrow
  leftarrowtail leftharpoondown leftharpoonup leftleftarrows Leftrightarrow leftrightarrow leftrightarrows
  leftrightharpoons leftrightsquigarrow leftthreetimes leq leqq leqslant lessapprox lessdot lesseqgtr lesseqqgtr
  lessgtr lesssim lfloor lgroup lhd ll llcorner Lleftarrow lll lmoustache lnapprox lneq lneqq lnot lnsim
  Longleftarrow longleftarrow Longleftrightarrow longleftrightarrow longmapsto Longrightarrow longrightarrow
  looparrowleft looparrowright lor lozenge lparen lrcorner Lsh ltimes lVert lvert lvertneqq maltese mapsto
  mathellipsis mathsterling measuredangle mho mid models mp mu multimap nabla natural ncong ndownarrow ne nearrow
  neg neq nexists ngeq ngeqq ngeqslant ngtr ni nLeftarrow nleftarrow nLeftrightarrow nleftrightarrow nleq nleqq
  nleqslant nless nmid notin nparallel nprec npreceq nRightarrow nrightarrow nshortmid nshortparallel nsim nsubseteq
  nsubseteqq nsucc nsucceq nsupseteq nsupseteqq ntriangleleft ntrianglelefteq ntriangleright ntrianglerighteq nu
  nuparrow nVDash nVdash nvDash nvdash nwarrow odot oint Omega omega ominus oplus ordinarycolon oslash otimes owns P
  parallel partial perp Phi phi Pi pi pitchfork pm pounds prec precapprox preccurlyeq preceq precnapprox precneqq
  precnsim precsim prime prod propto Psi psi rangle rbrace rbrack rceil Re restriction rfloor rgroup rhd rho
  Rightarrow rightarrow rightarrowtail rightharpoondown rightharpoonup rightleftarrows rightleftharpoons
  rightrightarrows rightsquigarrow rightthreetimes risingdotseq rmoustache rparen Rrightarrow Rsh rtimes rVert rvert
  S searrow setminus sharp shortmid shortparallel Sigma sigma sim simeq smallfrown smallint smallsetminus smallsmile
  smile spadesuit sphericalangle sqcap sqcup sqsubset sqsubseteq sqsupset sqsupseteq square star Subset subset
  subseteq subseteqq subsetneq subsetneqq succ succapprox succcurlyeq succeq succnapprox succneqq succnsim succsim
  sum Supset supset supseteq supseteqq supsetneq supsetneqq surd swarrow tau therefore Theta theta thickapprox
  thicksim times to top triangle triangledown triangleleft trianglelefteq triangleq triangleright trianglerighteq
  twoheadleftarrow twoheadrightarrow ulcorner unlhd unrhd Uparrow uparrow Updownarrow updownarrow upharpoonleft
  upharpoonright uplus Upsilon upsilon upuparrows urcorner varbigtriangledown varbigtriangleup varDelta varepsilon
  varGamma varkappa varLambda varnothing varOmega varPhi varphi varPi varpi varpropto varPsi varrho varSigma
  varsigma varsubsetneq varsubsetneqq varsupsetneq varsupsetneqq varTheta vartheta vartriangle vartriangleleft
  vartriangleright varUpsilon varXi vcentcolon Vdash vDash vdash vdots vee veebar Vert vert Vvdash wedge wp wr Xi xi
  yen zeta
]]

mathematics.operators = [[
  arccos arcsin arctan arg bmod cos cosh cot coth csc deg det dim exp gcd hom inf injlim ker lg lim liminf limsup ln
  log max min mod pmod pod Pr projlim sec sin sinh sup tan tanh varinjlim varliminf varlimsup varprojlim
]]

-- Accents, fonts, fractions, delimiters, spaces: what these take as arguments is looked through like all else.
mathematics.constructs = [[
  acute allowbreak atop bar Bbb begin bf Big big Bigg bigg Biggl biggl Biggm biggm Biggr biggr Bigl bigl Bigm bigm
  Bigr bigr binom bold boldsymbol boxed breve cal cfrac check choose dbinom ddddot dddot ddot dfrac displaylimits
  displaystyle dot end enskip enspace ensuremath fbox frac frak grave hat hdotsfor hfil hfill hline hphantom hskip
  hspace intertext it kern left leftroot limits mathbb mathbf mathbin mathcal mathclap mathclose mathfrak mathinner
  mathit mathllap mathnormal mathop mathopen mathord mathpunct mathrel mathring mathrlap mathrm mathsf mathstrut
  mathtt medspace middle mkern mskip mspace multicolumn negmedspace negthickspace negthinspace newline nobreak
  nolimits not of operatorname operatornamewithlimits over overbrace overbracket overleftarrow overleftrightarrow
  overline overrightarrow overset overunderset phantom pmb qquad quad relax right rm root rule scriptscriptstyle
  scriptstyle sf shortintertext shoveleft shoveright sideset smash sqrt stackrel strut substack tbinom textstyle
  tfrac thickspace thinspace tilde tt underbrace underbracket underleftarrow underleftrightarrow underline
  underrightarrow underset uproot vec vphantom widehat widetilde xhookleftarrow xhookrightarrow xLeftarrow
  xleftarrow xleftharpoondown xleftharpoonup xLeftrightarrow xleftrightarrow xleftrightharpoons xmapsto xRightarrow
  xrightarrow xrightharpoondown xrightharpoonup xrightleftharpoons
]]

-- Words within \text.
mathematics.text = [[
  AA aa AE ae b bfseries c d emph fg footnotesize guillemotleft guillemotright guilsinglleft guilsinglright H hbox
  Huge huge i itshape j k L l LARGE Large large LaTeX mbox mdseries normalfont normalsize O o OE oe og r rmfamily
  scriptsize scshape sffamily slshape small SS ss t TeX text textasciicircum textasciitilde textbackslash textbar
  textbf textbraceleft textbraceright textbullet textcelsius textcopyright textdegree textdollar textellipsis
  textemdash textendash texteuro textgreater textit textless textmd textminus textmu textnormal textohm textonehalf
  textonequarter textonesuperior textparagraph textperiodcentered textperthousand textpm textquotedblleft
  textquotedblright textquoteleft textquoteright textregistered textrm textsc textsection textsf textsl
  textsubscript textsuperscript textthreequarters textthreesuperior texttimes texttrademark texttt texttwosuperior
  textunderscore textup textvisiblespace tiny ttfamily u upshape v
]]

mathematics.environments = [[
  align align* alignat alignat* aligned alignedat array bmatrix bmatrix* Bmatrix Bmatrix* bsmallmatrix bsmallmatrix*
  Bsmallmatrix Bsmallmatrix* cases cases* dcases dcases* drcases drcases* equation equation* flalign flalign* gather
  gather* gathered lgathered matrix matrix* multline multline* multlined pmatrix pmatrix* psmallmatrix psmallmatrix*
  rcases rcases* rgathered smallmatrix smallmatrix* split subarray vmatrix vmatrix* Vmatrix Vmatrix* vsmallmatrix
  vsmallmatrix* Vsmallmatrix Vsmallmatrix*
]]

local function add_words(list, words)
  for word in list:gmatch("%S+") do words[word] = true end
  return words
end

local commands = {}
for _, list in ipairs { "symbols", "operators", "constructs", "text" } do add_words(mathematics[list], commands) end
local environments = add_words(mathematics.environments, {})

-- A backslash before a single character: spaces, signs, line breaks and, within \text, accents.
local single_characters = {}
for character in (",;:!>/-*|_%&#${}\\'`\"^~=. \t\n"):gmatch(".") do single_characters[character] = true end

-- What TeX would run for a \begin or \end whose argument starts at `at`, as long as that is a plain name.
local function environment_at(text, at) return text:match("^%s*{([A-Za-z]+%*?)}", at) end

-- What is not allowed of a formula, as {kind, what is written, text to look for}: "command", "environment", "comment".
function mathematics.refused_in(text)
  local refused, told = {}, {}
  local function refuse(kind, written, needle, subject)
    local known = subject or written
    if not told[known] then refused[#refused + 1] = { kind, written, needle or written } end
    told[known] = true
  end
  if text:find("^^", 1, true) then refuse("command", "^^") end
  local at = text:find("[\\%%]")
  while at do
    local word = text:match("^\\([A-Za-z@]+)", at)
    local after = at + 1 + (word and #word or 0)
    if text:sub(at, at) == "%" then
      refuse("comment", "%", text:sub(1, at):match("%S* ?%%$"))
    elseif not word then
      local character = text:match("^" .. utf8.charpattern, after) or ""
      if not single_characters[character] then refuse("command", "\\" .. character) end
      after = after + #character
    elseif not commands[word] then
      refuse("command", "\\" .. word)
    elseif (word == "begin" or word == "end") and not environments[environment_at(text, after)] then
      local argument = text:match("^%s*{[^{}\n]*}", after) or ""
      refuse("environment", "\\" .. word .. argument, nil, "\\begin" .. argument)
    end
    at = text:find("[\\%%]", after)
  end
  return refused
end

-- All that may stand behind a backslash, for proposals.
function mathematics.known()
  local words = {}
  for word in pairs(commands) do words[#words + 1] = word end
  table.sort(words)
  return table.concat(words, " ")
end

return mathematics
