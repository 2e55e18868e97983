-- GitHub's way to write formulas and links, for pandoc: see docs/site.sh.

function CodeBlock(block)
    if block.classes[1] == "math" then
        return pandoc.Para({ pandoc.Math("DisplayMath", block.text) })
    end
    if select(2, block.text:gsub("\n", "")) > 45 then -- may be split over pages
        block.classes:insert("long")
        return block
    end
end

function Inlines(list) -- $`...`$ is a Str that ends in $, a Code, and a Str that begins with $
    for i = #list - 1, 2, -1 do
        local before, code, after = list[i - 1], list[i], list[i + 1]
        if code.t == "Code" and before.t == "Str" and after.t == "Str" and
            before.text:sub(-1) == "$" and after.text:sub(1, 1) == "$" then
            before.text = before.text:sub(1, -2)
            after.text = after.text:sub(2)
            list[i] = pandoc.Math("InlineMath", code.text)
        end
    end
    for i = 1, #list - 1 do -- a number stays with its unit, a formula with its full stop
        local a, b = list[i], list[i + 1]
        if a.t == "Space" and b.t == "Str" and (b.text:match("^%%") or b.text:match("^[mn]?s$")) then
            list[i] = pandoc.Str("\u{a0}")
        elseif a.t == "Math" and a.mathtype == "InlineMath" and b.t == "Str" and b.text:match("^[,.;:)?!]") then
            list[i] = pandoc.Span({ a, b }, { style = "white-space: nowrap" })
            list[i + 1] = pandoc.Str("")
        end
    end
    return list
end

-- README.md becomes index.html, docs/NAME.md NAME.html; all other files keep their places.
local function moved(target)
    if target:match("^%a+:") or target:match("^#") then
        return target
    end
    if not target:match("^%.%./") and not target:match("^docs/") and PANDOC_STATE.input_files[1] ~= "README.md" then
        target = "docs/" .. target
    end
    target = target:gsub("^%.%./", "")
    target = target:gsub("^README%.md", "index.html")
    target = target:gsub("^docs/([%w%-]+)%.md", "%1.html")
    return (target:gsub("^docs/images/", "images/"))
end

function Link(link)
    link.target = moved(link.target)
    return link
end

function Image(image)
    image.src = moved(image.src)
    return image
end

function RawInline(raw) -- <img src="...">
    raw.text = raw.text:gsub('src="([^"]*)"', function(src) return 'src="' .. moved(src) .. '"' end)
    return raw
end

-- In a chapter of the site the first table, before and after, is the picture alive (see docs/live);
-- without a script, and on GitHub, it is the table. Below the first exercise is the editor.
function Pandoc(doc)
    local demo = doc.meta.demo and pandoc.utils.stringify(doc.meta.demo)
    local routines = doc.meta.routines and pandoc.utils.stringify(doc.meta.routines)
    local blocks, alive = pandoc.List(), false
    if not demo then
        return doc
    end
    for _, block in ipairs(doc.blocks) do
        if block.t == "Table" and not alive then
            block = pandoc.Div({ block }, { id = "live-" .. demo, class = "live", ["data-demo"] = demo })
            alive = true
        end
        blocks:insert(block)
        if routines and pandoc.utils.stringify(block):match("^1%. Write it yourself") then
            blocks:insert(pandoc.Div({}, { class = "edit", ["data-routines"] = routines, ["data-live"] = "live-" .. demo }))
            blocks:insert(pandoc.RawBlock("html", '<script defer src="edit/edit.js"></script>'))
        end
    end
    blocks:insert(pandoc.RawBlock("html", '<script src="live/' .. demo .. '.js"></script>\n<script src="live/live.js"></script>'))
    doc.blocks = blocks
    doc.meta["header-includes"] = pandoc.MetaBlocks { pandoc.RawBlock("html", '<link rel="icon" href="data:,">') }
    return doc
end
